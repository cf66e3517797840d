# mypy: ignore-errors
"""The arm of section 6.3 of the thesis, simulated: a skill that moves it, and a controller."""

import math

from ears import Ears, run
from geometry_msgs.msg import Point, Twist, Vector3, Wrench
from heron_msgs.msg import DetectedObject
from peg_in_hole_safety.msg import State
from skill_context_msgs.msg import RunningSkill, SkillContext, SkillPermission
from std_msgs.msg import Bool, Float64

NODE = "/peg_in_hole_safety"
PERIOD = 0.02  # s
PATIENCE = 50  # periods for which a target is wanted; the skill moves the arm afterwards
RETURN = 0.05  # m/s


class Peg(Ears):
    """Follows velocities, or goes to the last target while there are any.

    It says itself that no contact is allowed, unless `permits` is set: then its skill manager tells
    that a skill runs, which permits so much.
    """

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.speed = 0.0  # m/s along x, as the skill wants it
        self.push = 0.0  # N along z, as the skill wants it
        self.permits = None
        self._place = [-0.1, 0.2, 0.9]
        self._velocity = 0.0
        self._target, self._age = None, PATIENCE
        self._pose = self.publisher("/endEffectorPose", Point)
        self._contact = self.publisher("/contact_allowed", Bool)
        self._context = self.publisher("/skill_context", SkillContext)
        self._object = self.publisher("/detectobject", DetectedObject)
        self._inertia = self.publisher("/endEffectorInertia", Float64)
        self._wanted = self.publisher("/arm/unfil_velocity", Twist)
        self._pushed = self.publisher("/arm/unfil_wrench", Wrench)
        self.hear("/arm/velocity", Twist, self._moves)
        self.hear("/arm/wrench", Wrench, lambda m: m.force.z)
        self.hear("/arm/target", Point, self._returns)
        self.hear_latched(NODE + "/state", State)
        self.every(PERIOD, self._step)

    def _moves(self, command):
        self._velocity = command.linear.x
        return command.linear.x

    def _returns(self, target):
        self._target, self._age = [target.x, target.y, target.z], 0
        return self._target

    def _step(self):
        self._age += 1
        if self._age < PATIENCE:
            offset = [there - here for here, there in zip(self._place, self._target, strict=True)]
            length = math.sqrt(sum(each * each for each in offset))
            part = min(1.0, RETURN * PERIOD / length) if length else 0.0
            self._place = [
                here + part * each for here, each in zip(self._place, offset, strict=True)
            ]
        else:
            self._place[0] += self._velocity * PERIOD
        self.note("x", self._place[0])
        self._pose.publish(Point(x=self._place[0], y=self._place[1], z=self._place[2]))
        if self.permits is None:
            self._contact.publish(Bool(data=False))
        else:
            self._context.publish(self._reported())
        self._object.publish(DetectedObject(dist=1.0))
        self._inertia.publish(Float64(data=0.0))
        self._wanted.publish(Twist(linear=Vector3(x=self.speed, y=0.0, z=0.0)))
        self._pushed.publish(Wrench(force=Vector3(x=0.0, y=0.0, z=self.push)))

    def _reported(self):
        context, skill = SkillContext(), RunningSkill()
        skill.skill, skill.goal = "Insert", "Insert 1"
        for kind in self.permits:
            permission = SkillPermission()
            permission.kind, permission.type, permission.limit = kind, "skiros.Product", math.nan
            skill.permits.append(permission)
        context.running = [skill]
        return context


if __name__ == "__main__":
    run(Peg)
