"""The skills of `passed_values` by SkiROS2's own API, and the values that they have there.

Real SkiROS2 gives these values (tests/ezskiros/hosts shows it), and so does our engine with
`--compatible`.
"""

from __future__ import annotations

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


class Tell(SkillDescription):
    def createDescription(self):
        self.addParam("Force", float, ParamTypes.Required)
        self.addParam("Speed", float, ParamTypes.Required)


class tell(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Tell(), "tell")

    def execute(self):
        return self.success(f"{self.params['Force'].value} {self.params['Speed'].value}")


class Again(SkillDescription):
    def createDescription(self):
        self.addParam("Force", float, ParamTypes.Required)


class again(SkillBase):
    def createDescription(self):
        self.setDescription(Again(), "again")

    def expand(self, skill):
        expand(self, skill, "Tell(Force=params.Force, Speed=params.Force * 2)")


class Both(SkillDescription):
    def createDescription(self):
        self.addParam("Force", float, ParamTypes.Required)
        self.addParam("Speed", float, ParamTypes.Required)


class both(SkillBase):
    def createDescription(self):
        self.setDescription(Both(), "both")

    def expand(self, skill):
        expand(self, skill, "Again(Force=params.Speed)")


class Grow(SkillDescription):
    def createDescription(self):
        self.addParam("Force", float, ParamTypes.Required)


class grow(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Grow(), "grow")

    def execute(self):
        force = self.params["Force"]
        force.value = force.value + 1
        return self.step() if force.value < 11 else self.success(f"{force.value}")


class Stay(SkillDescription):
    def createDescription(self):
        self.addParam("Force", 0.75, ParamTypes.Required)


class stay(PrimitiveBase):
    count = 0

    def createDescription(self):
        self.setDescription(Stay(), "stay")

    def execute(self):
        self.count += 1
        return self.step() if self.count < 3 else self.success(f"{self.params['Force'].value}")


class Say(SkillDescription):
    def createDescription(self):
        self.addParam("Force", "hard", ParamTypes.Required)
        self.addParam("Word", "soft", ParamTypes.Required)


class say(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Say(), "say")

    def execute(self):
        return self.success(f"{self.params['Force'].value} {self.params['Word'].value}")


class Read(SkillDescription):
    def createDescription(self):
        self.addParam("Word", str, ParamTypes.Optional)


class read(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Read(), "read")

    def execute(self):
        return self.success(f"{self.params['Word'].value}")


class Count(SkillDescription):
    def createDescription(self):
        self.addParam("Word", int, ParamTypes.Optional)


class count(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Count(), "count")

    def execute(self):
        return self.success(f"{self.params['Word'].value}")


class Note(SkillDescription):
    def createDescription(self):
        self.addParam("Force", float, ParamTypes.Optional)
        self.addParam("Speed", float, ParamTypes.Optional)


class note(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Note(), "note")

    def execute(self):
        return self.success(f"{self.params['Force'].value} {self.params['Speed'].value}")


class Chain(SkillDescription):
    def createDescription(self):
        self.addParam("One", float, ParamTypes.Required)
        self.addParam("Other", float, ParamTypes.Required)


class chain(SkillBase):
    def createDescription(self):
        self.setDescription(Chain(), "chain")

    def expand(self, skill):
        expand(self, skill, "Note(Force=params.Other, Speed=params.One)")


class Deep(SkillDescription):
    def createDescription(self):
        self.addParam("Fails", False, ParamTypes.Required)


class deep(SkillBase):
    def createDescription(self):
        self.setDescription(Deep(), "deep")

    def expand(self, skill):
        expand(self, skill, "Read()")


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
"""As somebody writes them who does not know EzSkiROS."""

TREES = [
    ("Push(Force=params.Mine), Push(), Push(Force=params.Mine)", ["0.5 0.1", "0.5 0.1", "0.5 0.1"]),
    ("Push(Force=params.Force), Push(Force=params.Force)", ["0.5 0.1", "0.5 0.1"]),
    ("Push(Force=params.Speed, Speed=params.Force)", ["0.5 0.1"]),
    ("Push(), Push(Force=params.Force, Speed=params.Speed)", ["0.5 0.1", "0.5 0.1"]),
    ("Push(Force=params.Mine, Speed=params.Mine)", ["0.5 0.1"]),
    ("Push(Force=params.Mine * 2), Push(Force=params.Mine)", ["16.0 0.1", "0.5 0.1"]),
    ("Push(Force=params.Unset), Twice(Force=params.Unset)", ["0.5 0.1", "0.5 0.1", "0.5 0.1"]),
    ("Twice(Force=params.Mine), Push(Force=params.Force)", ["0.5 0.1", "0.5 0.1", "0.5 0.1"]),
    ("Twice(), Push(Force=params.Force)", ["0.5 0.1", "0.5 0.1", "0.5 0.1"]),
    ("Twice(Force=7.0), Push(Force=params.Force)", ["0.5 0.1", "0.5 0.1", "0.5 0.1"]),
    ("self.parallelff(Push(Force=params.Mine), Push(Speed=params.Mine))", ["0.5 0.1", "0.5 0.1"]),
    ("Weigh(), Push(Force=params.Found)", ["3.5", "0.5 0.1"]),
    ("Weigh(Found=2.0), Push(Force=params.Found)", ["3.5", "0.5 0.1"]),
    ("self.nofail(Weigh(Fails=True)), Push(Force=params.Found)", ["empty", "0.5 0.1"]),
    ("Weigh(Found=params.Mine), Push(Force=params.Mine)", ["3.5", "0.5 0.1"]),
    (
        "Double(Force=params.Mine, Twofold=params.Found), Push(Force=params.Found)",
        ["16.0", "0.5 0.1"],
    ),
    ("Both(Force=params.Mine)", ["2.0 8.0"]),
    ("Push(Force=params.Mine), Tell(Force=params.Mine)", ["0.5 0.1", "0.5 0.1"]),
    ("Push(), Tell()", ["0.5 0.1", "0.5 0.1"]),
    ("Push(Force=7.0), Tell()", ["7.0 0.1", "7.0 0.1"]),
    ("Tell(Force=params.Speed, Speed=params.Force)", ["2.0 4.0"]),
    ("Tell(Force=params.Mine, Speed=params.Mine)", ["8.0 4.0"]),
    ("Twice(Force=params.Mine), Tell(Force=params.Mine)", ["0.5 0.1", "0.5 0.1", "0.25 0.1"]),
    ("Twice(Force=7.0), Tell()", ["0.5 0.1", "0.5 0.1", "7.0 0.1"]),
    ("Twice(), Tell(Speed=params.Mine)", ["0.5 0.1", "0.5 0.1", "0.25 8.0"]),
    (
        "Double(Force=params.Mine, Twofold=params.Found), Tell(Force=params.Found)",
        ["16.0", "16.0 4.0"],
    ),
    (
        "Double(Twofold=params.Mine), Twice(), Tell(Speed=params.Mine)",
        ["4.0", "0.5 0.1", "0.5 0.1", "0.25 4.0"],
    ),
    ("Weigh(), Tell(Force=params.Found)", ["3.5", "3.5 4.0"]),
    ("Weigh(Found=params.Mine), Tell(Speed=params.Mine)", ["3.5", "2.0 3.5"]),
    ("self.nofail(Weigh(Fails=True)), Tell(Speed=params.Found)", ["empty", "2.0 1.0"]),
    (
        "self.parallelff(Again(Force=params.Mine), Grow(Force=params.Mine)), Again()",
        ["8.0 16.0", "9.0 16.0", "10.0 16.0", "11.0", "2.0 4.0"],
    ),
    (
        "self.parallelff(Push(Force=7.0), Stay(), Tell())",
        ["7.0 0.1", "0.75 0.1", "7.0 0.1", "0.75 0.1", "7.0 0.1", "0.75", "0.75 0.1"],
    ),
    ("Say(), Tell()", ["hard soft", "2.0 4.0"]),
    ("Say(), Deep(), Count(), Deep()", ["hard soft", "soft", "None", "None"]),
    ("Say(), Read()", ["hard soft", "soft"]),
    ("Chain(One=params.Force, Other=params.Mine)", ["8.0 None"]),
    (
        "Note(), Chain(One=params.Force, Other=params.Mine), Note()",
        ["2.0 4.0", "8.0 None", "2.0 4.0"],
    ),
]
"""Trees, and the values that their primitives have in SkiROS2; `Mine` is given, 8.0."""
IDS = [tree for tree, _ in TREES]
PRIMITIVES = ("push", "tell", "weigh", "double", "grow", "stay", "say", "read", "count", "note")


def skills(tree: str) -> str:
    """The skills for SkiROS2, among them `Task` with these children."""
    return NATIVE.replace("{tree}", tree)
