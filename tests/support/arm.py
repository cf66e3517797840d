# mypy: ignore-errors
"""The arm of the thesis, simulated: a controller, an action server, and the skill that uses it."""

import math
import time

from arm_safety.msg import State
from ears import Client, Ears, Server, run
from geometry_msgs.msg import Vector3, Wrench
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool

NODE = "/arm_safety"
PERIOD = 0.01  # s
RETRACTED = "retracted"  # the pose in which the arm touches nothing
SWING, FREQUENCY = 30.0, 2.0  # N, Hz; of an arm that presses on something
BRAKING = 0.1  # s; for so long the arm moves on when its goal is over


class Arm(Ears):
    """Publishes the force at its end effector and the velocity of its joints."""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.touches = False  # whether something is in the way unless the arm is retracted
        self.gives_way = False  # whether that is gone once the arm is retracted
        self.obeys = True  # whether the arm stands without a goal
        self._is_retracted = False
        self._moved_at = 0.0
        self._wrench = self.publisher("/Wrench", Wrench)
        self._joints = self.publisher("/joint_states", JointState)
        action = ("/arm", "heron_msgs/MoveArm", "pose")
        self._server = Server(self, *action, self._end_of)
        self._client = Client(self, *action)
        self.offer_parameter("/arm_controller", "stiffness", 1000.0)
        self.hear("/arm/stop", Bool, lambda m: m.data)
        self.hear_latched(NODE + "/state", State)
        self.every(PERIOD, self._publish)

    def _publish(self):
        swings = self.touches and not self._is_retracted
        force = SWING * math.sin(2 * math.pi * FREQUENCY * time.time()) if swings else 0.0
        self._wrench.publish(Wrench(force=Vector3(x=0.0, y=0.0, z=force)))
        if self._server.pursued is not None or not self.obeys:
            self._moved_at = time.time()
        speed = 0.2 if time.time() - self._moved_at < BRAKING else 0.0
        self.note("speed", speed)
        self._joints.publish(JointState(name=["elbow"], velocity=[speed]))

    def _end_of(self, pose):
        """The skill holds its pose until it is reported otherwise."""
        self._is_retracted = pose == RETRACTED
        self.touches = self.touches and not (self._is_retracted and self.gives_way)
        return "succeeds" if self._is_retracted else None

    def answer(self, request):
        """Answer a request."""
        if "goal" in request:
            self._client.send(request["goal"])
        return super().answer(request)


if __name__ == "__main__":
    run(Arm)
