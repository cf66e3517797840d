"""Skills that pass values to each other, and the values that their primitives have."""

from __future__ import annotations

SKILLS = """
class Push(SkillDescription):
    def description(self, Force: float = 0.5, Speed: float = 0.1):
        pass


class push(Push.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Force} {self.params.Speed}")


class Twice(SkillDescription):
    def description(self, Force: float = 0.25):
        pass


class twice(Twice.SkillBase):
    def expandBT(self, params):
        self.serialstar(Push(Force=params.Force), Push(Speed=params.Force))


class Weigh(SkillDescription):
    def description(self, Found: OPTIONAL[float] = 1.0, Fails: bool = False):
        pass


class weigh(Weigh.SkillBase):
    def execute(self):
        if self.params.Fails:
            return self.fail("empty", -1)
        self.params.Found = 3.5
        return self.success(f"{self.params.Found}")


class Double(SkillDescription):
    def description(self, Force: float, Twofold: OUTPUT[float]):
        pass


class double(Double.SkillBase):
    def execute(self):
        self.params.Twofold = 2 * self.params.Force
        return self.success(f"{self.params.Twofold}")


class Task(SkillDescription):
    def description(self, *, Mine: float = 1.0, Force: float = 2.0, Speed: float = 4.0,
                    Found: OPTIONAL[float] = 6.0, Unset: OPTIONAL[float]):
        pass


class task(Task.SkillBase):
    def expandBT(self, params):
        self.serialstar({tree})
"""

TREES = [
    ("Push(Force=params.Mine), Push(), Push(Force=params.Mine)", ["8.0 0.1", "0.5 0.1", "8.0 0.1"]),
    ("Push(Force=params.Force), Push(Force=params.Force)", ["2.0 0.1", "2.0 0.1"]),
    ("Push(Force=params.Speed, Speed=params.Force)", ["4.0 2.0"]),
    ("Push(), Push(Force=params.Force, Speed=params.Speed)", ["0.5 0.1", "2.0 4.0"]),
    ("Push(Force=params.Mine, Speed=params.Mine)", ["8.0 8.0"]),
    ("Push(Force=params.Mine * 2), Push(Force=params.Mine)", ["16.0 0.1", "8.0 0.1"]),
    ("Push(Force=params.Unset), Twice(Force=params.Unset)", ["0.5 0.1", "0.5 0.1", "0.5 0.5"]),
    ("Twice(Force=params.Mine), Push(Force=params.Force)", ["8.0 0.1", "0.5 8.0", "2.0 0.1"]),
    ("Twice(), Push(Force=params.Force)", ["0.25 0.1", "0.5 0.25", "2.0 0.1"]),
    ("Twice(Force=7.0), Push(Force=params.Force)", ["7.0 0.1", "0.5 7.0", "2.0 0.1"]),
    ("self.parallelff(Push(Force=params.Mine), Push(Speed=params.Mine))", ["8.0 0.1", "0.5 8.0"]),
    ("Weigh(), Push(Force=params.Found)", ["3.5", "3.5 0.1"]),
    ("Weigh(Found=2.0), Push(Force=params.Found)", ["3.5", "6.0 0.1"]),
    ("self.nofail(Weigh(Fails=True)), Push(Force=params.Found)", ["empty", "6.0 0.1"]),
    ("Weigh(Found=params.Mine), Push(Force=params.Mine)", ["3.5", "3.5 0.1"]),
    (
        "Double(Force=params.Mine, Twofold=params.Found), Push(Force=params.Found)",
        ["16.0", "16.0 0.1"],
    ),
]
"""Trees, and the values that their primitives have: `Mine` is given, 8.0."""
IDS = [tree for tree, _ in TREES]


def skills(tree: str) -> str:
    """The skills, among them `Task` with these children; `Mine` is to be given."""
    return SKILLS.replace("{tree}", tree)


NATIVE = """
from skiros2_common.core.params import ParamTypes
from skiros2_common.core.primitive import PrimitiveBase
from skiros2_skill.core.skill import SkillBase, SkillDescription

from support.native_trees import expand


class Push(SkillDescription):
    def createDescription(self):
        self.addParam("Force", 0.5, ParamTypes.Required)
        self.addParam("Speed", 0.1, ParamTypes.Required)


class push(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Push(), "push")

    def execute(self):
        return self.success(f"{self.params['Force'].value} {self.params['Speed'].value}")


class Twice(SkillDescription):
    def createDescription(self):
        self.addParam("Force", 0.25, ParamTypes.Required)


class twice(SkillBase):
    def createDescription(self):
        self.setDescription(Twice(), "twice")

    def expand(self, skill):
        expand(self, skill, "Push(Force=params.Force), Push(Speed=params.Force)")


class Weigh(SkillDescription):
    def createDescription(self):
        self.addParam("Found", 1.0, ParamTypes.Optional)
        self.addParam("Fails", False, ParamTypes.Required)


class weigh(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Weigh(), "weigh")

    def execute(self):
        if self.params["Fails"].value:
            return self.fail("empty", -1)
        self.params["Found"].value = 3.5
        return self.success(f"{self.params['Found'].value}")


class Double(SkillDescription):
    def createDescription(self):
        self.addParam("Force", float, ParamTypes.Required)
        self.addParam("Twofold", float, ParamTypes.Optional)


class double(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Double(), "double")

    def execute(self):
        self.params["Twofold"].value = 2 * self.params["Force"].value
        return self.success(f"{self.params['Twofold'].value}")


class Task(SkillDescription):
    def createDescription(self):
        for key, value in {"Mine": 1.0, "Force": 2.0, "Speed": 4.0}.items():
            self.addParam(key, value, ParamTypes.Required)
        self.addParam("Found", 6.0, ParamTypes.Optional)
        self.addParam("Unset", float, ParamTypes.Optional)


class task(SkillBase):
    def createDescription(self):
        self.setDescription(Task(), "task")

    def expand(self, skill):
        expand(self, skill, '''{tree}''')
"""
"""The same skills by SkiROS2's own API, as somebody writes them who does not know EzSkiROS."""


def native_skills(tree: str) -> str:
    """The skills for SkiROS2, among them `Task` with these children."""
    return NATIVE.replace("{tree}", tree)
