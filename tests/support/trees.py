"""Behavior trees for tests: how the children of one are written in, findings out."""

from __future__ import annotations

from textwrap import dedent, indent

from ezskiros.driver import Checked
from support.skill_files import HEADER, checked

LIBRARY = (
    HEADER
    + """

class Measure(SkillDescription):
    def description(self, Force: OUTPUT[float]): ...


class measure(Measure.SkillBase):
    def execute(self):
        self.params.Force = 3.5
        return self.success("measured")


class Grip(SkillDescription):
    def description(self, Force: float): ...


class grip(Grip.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Force} N")


class Say(SkillDescription):
    def description(self, Force: str): ...


class say(Say.SkillBase):
    def execute(self):
        return self.success(self.params.Force)


class Drive(SkillDescription):
    def description(
        self, Target: skiros.Location, Start: OPTIONAL[skiros.Location], Speed: float = 0.1
    ): ...


class drive(Drive.SkillBase):
    def execute(self):
        if self.progress[0] < 3:
            return self.step(f"from {self.params.Start} to {self.params.Target}")
        return self.success("there")


class Point(SkillDescription):
    def description(self, Arm: rparts.ArmDevice): ...


class point(Point.SkillBase):
    def execute(self):
        return self.success(f"with {self.params.Arm}")


class Watch(SkillDescription):
    def description(self): ...


class watch(Watch.SkillBase):
    def execute(self):
        return self.step("watching")


class Dream(SkillDescription):
    def description(self): ...
"""
)
"""Skills of all kinds; nothing implements the last."""
LINES = LIBRARY.count("\n")
PARAMETERS = (
    "Place: skiros.Location, Box: skiros.Product, Force: float, Name: str, Speed: float = 0.1"
)
IS_USED = "self.pre_conditions += Place.contain(Box)"


def tree(body: str, parameters: str = PARAMETERS) -> Checked:
    """The findings in a compound skill whose `expandBT` has this body."""
    condition = IS_USED if parameters == PARAMETERS else "pass"
    lines = indent(dedent(body).strip(), " " * 8)
    own = ", ".join(filter(None, ["self", parameters]))
    return checked(
        f"{LIBRARY}\n\nclass Task(SkillDescription):\n    def description({own}):\n"
        f"        {condition}\n\n\nclass task(Task.SkillBase):\n"
        f"    def expandBT(self, params):\n{lines}\n"
    )


def primitive(methods: str) -> Checked:
    """The findings in a primitive skill with these methods."""
    lines = indent(dedent(methods).strip(), " " * 4)
    return checked(
        f"{HEADER}\n\nclass Skill(SkillDescription):\n    def description(self): ...\n\n\n"
        f"class skill(Skill.SkillBase):\n{lines}\n"
    )


def findings(result: Checked) -> list[tuple[str, str]]:
    """Codes, and the texts at their places."""
    return [(each.code, each.primary.span.text) for each in result.diagnostics]
