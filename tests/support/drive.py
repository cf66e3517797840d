# mypy: ignore-errors
"""The mobile base of the thesis, simulated: a drive that follows /cmd_vel, and its planner."""

import math
import time

from ears import Ears, run
from geometry_msgs.msg import Quaternion, Twist
from mobile_base_safety.msg import State, Verdict
from nav_msgs.msg import Odometry
from std_msgs.msg import Bool

NODE = "/mobile_base_safety"
PERIOD = 0.02  # s
ACCELERATION = 0.5  # m/s^2
PATIENCE = 0.5  # s; without commands for longer than this the drive stops


class Drive(Ears):
    """Publishes its pitch and its speed, and what its planner wants."""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.pitch = 0.0  # degrees
        self.wanted = 0.4  # m/s
        self._speed = 0.0
        self._imu = self.publisher("/imuInformation", Quaternion)
        self._odometry = self.publisher("/odom", Odometry)
        self._planner = self.publisher("/unfil_cmd_vel", Twist)
        self.hear("/cmd_vel", Twist, lambda m: m.linear.x)
        self.hear("/drive/boost", Bool, lambda m: m.data)
        self.hear_latched(NODE + "/state", State)
        self.hear(NODE + "/verdicts", Verdict)
        self.every(PERIOD, self._move)

    def _move(self):
        change = self._commanded() - self._speed
        self._speed += max(-ACCELERATION * PERIOD, min(ACCELERATION * PERIOD, change))
        self.note("speed", self._speed)
        half = math.radians(self.pitch) / 2
        self._imu.publish(Quaternion(x=0.0, y=math.sin(half), z=0.0, w=math.cos(half)))
        odometry = Odometry()
        odometry.twist.twist.linear.x = self._speed
        self._odometry.publish(odometry)
        command = Twist()
        command.linear.x = self.wanted
        self._planner.publish(command)

    def _commanded(self):
        reported = self.heard.get("/cmd_vel")
        is_fresh = reported and time.time() - reported[-1][0] < PATIENCE
        return reported[-1][1] if is_fresh else 0.0


if __name__ == "__main__":
    run(Drive)
