"""Implementations that have pre-conditions of their own, and which of them SkiROS2 and the engine
take for which individual. The nut weighs 2, the bolt 5, and nobody knows the weight of the feather.
"""

from __future__ import annotations

SCENE = """
skiros:Product-3 a skiros:Product ; rdfs:label "nut" ; skiros:Weight 2.0 .
skiros:Product-4 a skiros:Product ; rdfs:label "bolt" ; skiros:Weight 5.0 .
skiros:Product-5 a skiros:Product ; rdfs:label "feather" .
cora:Robot-6 a cora:Robot ; rdfs:label "robot" .
"""
SKILLS = """
class Move(SkillDescription):
    def description(self, Object: skiros.Product):
        pass


class lift(Move.SkillBase):
    def conditions(self, Object):
        self.pre_conditions += Object.Weight == 2.0

    def execute(self):
        self.world.set_value(self.params.Object, skiros.Weight, 5.0)
        return self.success(f"lifted {self.params.Object.label}")


class Shove(SkillDescription):
    def description(self, Piece: skiros.Product):
        pass


class shove(Shove.SkillBase):
    def execute(self):
        self.world.set_value(self.params.Piece, skiros.Weight, 2.0)
        return self.success(f"shoved {self.params.Piece.label}")


class push(Move.SkillBase):
    def conditions(self, Object):
        self.pre_conditions += Object.Weight
        self.pre_conditions += ~(Object.Weight < 3.0)

    def expandBT(self, params):
        self.serialstar(Shove(Piece=params.Object), Shove(Piece=params.Object))


class leave(Move.SkillBase):
    def conditions(self, Object):
        self.pre_conditions += ~Object.Weight

    def execute(self):
        return self.success(f"left {self.params.Object.label}")


class Task(SkillDescription):
    def description(self, One: skiros.Product, Object: skiros.Product):
        pass


class task(Task.SkillBase):
    def expandBT(self, params):
        {tree}
"""
TREES: list[tuple[str, str, list[str] | str]] = [
    ("nut", "Move(Object=params.One)", ["lifted nut"]),
    ("bolt", "Move(Object=params.One)", ["shoved bolt", "shoved bolt"]),
    ("feather", "Move(Object=params.One)", ["left feather"]),
    ("nut", "Move.lift(Object=params.One)", ["lifted nut"]),
    ("feather", "Move.leave(Object=params.One)", ["left feather"]),
    ("bolt", "Move.lift(Object=params.One)", "Object.Weight == 2.0"),
    ("nut", "Move.push(Object=params.One)", "~(Object.Weight < 3.0)"),
    # What the first makes of the nut decides about the second.
    (
        "nut",
        "self.serialstar(Move(Object=params.One), Move(Object=params.One))",
        ["lifted nut", "shoved nut", "shoved nut"],
    ),
    # One child that starts again with another implementation.
    (
        "nut",
        "self.retry(self.inverter(Move(Object=params.One)), 3)",
        ["lifted nut", "shoved nut", "shoved nut", "lifted nut"],
    ),
    (
        "bolt",
        "self.retry(self.inverter(Move(Object=params.One)), 3)",
        ["shoved bolt", "shoved bolt", "lifted bolt", "shoved bolt", "shoved bolt"],
    ),
    # The child's own parameter is not the one of that name above it.
    (
        "nut",
        "self.serialstar(Move(Object=params.Object), Move(Object=params.One))",
        ["left feather", "lifted nut"],
    ),
]
"""Cases: the class of `One`, the tree, and the expected messages of the primitives or the failing
condition.
"""


def skills(tree: str) -> str:
    """The skills with a tree of the task."""
    return SKILLS.replace("{tree}", tree)


NATIVE = """
from skiros2_common.core.params import ParamTypes
from skiros2_common.core.primitive import PrimitiveBase
from skiros2_common.core.world_element import Element
from skiros2_skill.core.skill import SkillBase, SkillDescription


class Move(SkillDescription):
    def createDescription(self):
        self.addParam("Object", Element("skiros:Product"), ParamTypes.Required)


class lift(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Move(), self.__class__.__name__)

    def modifyDescription(self, skill):
        skill.addPreCondition(
            self.getPropCond("Light", "skiros:Weight", "Object", "=", 2.0, True))

    def execute(self):
        return self.success("lifted %s" % self.params["Object"].value.label)


class Shove(SkillDescription):
    def createDescription(self):
        self.addParam("Piece", Element("skiros:Product"), ParamTypes.Required)


class shove(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Shove(), self.__class__.__name__)

    def execute(self):
        return self.success("shoved %s" % self.params["Piece"].value.label)


class push(SkillBase):
    def createDescription(self):
        self.setDescription(Move(), self.__class__.__name__)

    def modifyDescription(self, skill):
        # Heavy individuals
        skill.addPreCondition(self.getHasPropCond("Weighed", "skiros:Weight", "Object", True))
        skill.addPreCondition(
            self.getPropCond("Heavy", "skiros:Weight", "Object", "<", 3.0, False))

    def expand(self, skill):
        skill(
            self.skill("Shove", "", remap={"Piece": "Object"}),
            self.skill("Shove", "", remap={"Piece": "Object"}),
        )


class leave(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Move(), self.__class__.__name__)

    def modifyDescription(self, skill):
        skill.addPreCondition(self.getHasPropCond("Unknown", "skiros:Weight", "Object", False))

    def execute(self):
        return self.success("left %s" % self.params["Object"].value.label)


class Task(SkillDescription):
    def createDescription(self):
        self.addParam("One", Element("skiros:Product"), ParamTypes.Required)
        self.addParam("Two", Element("skiros:Product"), ParamTypes.Required)


class task(SkillBase):
    def createDescription(self):
        self.setDescription(Task(), self.__class__.__name__)

    def expand(self, skill):
        skill(
            self.skill("Move", "", remap={"Object": "One"}),
            self.skill("Move", "", remap={"Object": "Two"}),
        )
"""
"""Skills by SkiROS2's own API: they change nothing, and have no `Object` in the task."""
PAIRS = [
    ("nut", "feather", ["lifted nut", "left feather"]),
    ("bolt", "nut", ["shoved bolt", "shoved bolt", "lifted nut"]),
    ("feather", "bolt", ["left feather", "shoved bolt", "shoved bolt"]),
]
"""`One` and `Two` of the task there, and what is reported. SkiROS2's master takes `lift` only:
there the nut is lifted, and all else fails.
"""
