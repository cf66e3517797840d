# mypy: ignore-errors
"""A robot whose skills say that they run, in live tests: `skillful.py NAMESPACE`.

It feels a force, and its planner wants 1 m/s. Its node is `skillful_safety`.
"""

import math
import sys

from ears import Ears, run
from geometry_msgs.msg import Twist, WrenchStamped
from skill_context_msgs.msg import (
    RunningSkill,
    SkillAhead,
    SkillArgument,
    SkillContext,
    SkillPermission,
    SkillProperty,
)
from skillful_safety.msg import State, Verdict
from skillful_safety.srv import Exempt
from std_msgs.msg import Bool

SPACE = sys.argv[1] if len(sys.argv) > 1 else ""
NODE = SPACE + "/skillful_safety"


class Skillful(Ears):
    """Publishes what it is reported, and remembers what it hears. `skills` are pairs of a skill and
    its arguments, which are triples of a parameter, a class and a weight (kg). All of them permit
    what `permits` names.
    """

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.digest, self.skills, self.is_talking, self.force = "", [], True, 0.0
        self.permits = []
        self.ahead = []  # None: nobody knows
        self._contexts = self.publisher(SPACE + "/skill_context", SkillContext)
        self._forces = self.publisher(SPACE + "/ft", WrenchStamped)
        self._planner = self.publisher(SPACE + "/unfil_cmd_vel", Twist)
        self.hear(SPACE + "/cmd_vel", Twist, lambda message: message.linear.x)
        self.hear(SPACE + "/contact_allowed", Bool, lambda message: message.data)
        self.hear_latched(NODE + "/state", State)
        self.hear(NODE + "/verdicts", Verdict)
        self.every(0.1, self._tell)
        self.every(0.05, self._feel)

    def _tell(self):
        if not self.is_talking:
            return
        context = SkillContext()
        context.digest = self.digest
        for name, arguments in self.skills:
            skill = RunningSkill()
            skill.skill, skill.goal = name, name + " 1"
            skill.arguments = [self._argument(*each) for each in arguments]
            skill.permits = [self._permission(each) for each in self.permits]
            context.running.append(skill)
        context.is_ahead_known = self.ahead is not None
        for name, arguments in self.ahead or ():
            skill = SkillAhead()
            skill.skill = name
            skill.arguments = [self._argument(*each) for each in arguments]
            context.ahead.append(skill)
        self.note("context", None)
        self._contexts.publish(context)

    def _argument(self, parameter, kind, weight):
        argument = SkillArgument()
        argument.parameter, argument.type, argument.number = parameter, kind, math.nan
        found = SkillProperty()
        found.property, found.number = "skiros.Weight", weight
        argument.properties = [found]
        return argument

    def _permission(self, kind):
        permission = SkillPermission()
        permission.kind, permission.type, permission.limit = kind, "skiros.Product", math.nan
        return permission

    def _feel(self):
        wrench, twist = WrenchStamped(), Twist()
        wrench.wrench.force.x = float(self.force)
        twist.linear.x = 1.0
        self._forces.publish(wrench)
        self._planner.publish(twist)

    def answer(self, request):
        """Answer a request."""
        if "exempt" in request:
            duration = self.duration_of(60.0)
            return self.call(NODE + "/exempt", Exempt, {**request["exempt"], "time": duration})
        return super().answer(request)


if __name__ == "__main__":
    run(Skillful, "skillful" + SPACE.replace("/", "_"))
