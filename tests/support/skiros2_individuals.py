"""Skills that pass individuals to each other, in EzSkiROS and by SkiROS2's own API, and what they
tell there. `A` and `B` are places, `Object` is a product; another one of the same weight is there.
"""

from __future__ import annotations

SCENE = """
skiros:Location-1 a skiros:Location ; rdfs:label "bench" .
skiros:Location-2 a skiros:Location ; rdfs:label "shelf" .
skiros:Product-3 a skiros:Product ; rdfs:label "nut" ; skiros:Weight 2.0 .
skiros:Product-4 a skiros:Product ; rdfs:label "bolt" ; skiros:Weight 2.0 .
cora:Robot-5 a cora:Robot ; rdfs:label "robot" .
"""
SKILLS = """
class See(SkillDescription):
    def description(self, A: skiros.Location, B: skiros.Location):
        pass


class see(See.SkillBase):
    def execute(self):
        return self.success(f"{self.params.A.label} {self.params.B.label}")


class Find(SkillDescription):
    def description(self, Heavy: INFERRED[skiros.Product]):
        self.pre_conditions += Heavy.Weight == 2.0


class find(Find.SkillBase):
    def execute(self):
        self.world.set_value(self.params.Heavy, skiros.Weight, 1.0)
        return self.success("found")


class Remove(SkillDescription):
    def description(self, Object: skiros.Product):
        pass


class remove(Remove.SkillBase):
    def execute(self):
        self.world.remove(self.params.Object)
        return self.success("removed")


class Look(SkillDescription):
    def description(self, Object: OPTIONAL[skiros.Product]):
        pass


class look(Look.SkillBase):
    def execute(self):
        found = self.params.Object
        return self.success("nothing" if found is None else found.label)


class Take(SkillDescription):
    def description(self, Taken: OPTIONAL[skiros.Product], Other: skiros.Product):
        pass


class take(Take.SkillBase):
    def execute(self):
        self.params.Taken = self.params.Other
        return self.success(f"{self.params.Taken.label}")


class Task(SkillDescription):
    def description(
        self, *, A: skiros.Location, B: skiros.Location, Object: skiros.Product,
        Unset: OPTIONAL[skiros.Product],
    ):
        pass


class task(Task.SkillBase):
    def expandBT(self, params):
        self.serialstar({tree})
"""
NATIVE = """
from skiros2_common.core.params import ParamTypes
from skiros2_common.core.primitive import PrimitiveBase
from skiros2_common.core.world_element import Element
from skiros2_skill.core.skill import SkillBase, SkillDescription

from support.native_trees import expand

LOCATION, PRODUCT = Element("skiros:Location"), Element("skiros:Product")


class See(SkillDescription):
    def createDescription(self):
        self.addParam("A", LOCATION, ParamTypes.Required)
        self.addParam("B", LOCATION, ParamTypes.Required)


class see(PrimitiveBase):
    def createDescription(self):
        self.setDescription(See(), "see")

    def execute(self):
        return self.success(f"{self.params['A'].value.label} {self.params['B'].value.label}")


class Find(SkillDescription):
    def createDescription(self):
        self.addParam("Heavy", PRODUCT, ParamTypes.Inferred)
        heavy = self.getPropCond("Heavy", "skiros:Weight", "Heavy", "=", 2.0, True)
        self.addPreCondition(heavy)


class find(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Find(), "find")

    def execute(self):
        found = self.params["Heavy"].value
        found.setProperty("skiros:Weight", 1.0)
        self._wmi.update_element(found)
        return self.success("found")


class Remove(SkillDescription):
    def createDescription(self):
        self.addParam("Object", PRODUCT, ParamTypes.Required)


class remove(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Remove(), "remove")

    def execute(self):
        self._wmi.remove_element(self.params["Object"].value)
        return self.success("removed")


class Look(SkillDescription):
    def createDescription(self):
        self.addParam("Object", PRODUCT, ParamTypes.Optional)


class look(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Look(), "look")

    def execute(self):
        found = self.params["Object"].value
        return self.success(found.label if found.id else "nothing")


class Take(SkillDescription):
    def createDescription(self):
        self.addParam("Taken", PRODUCT, ParamTypes.Optional)
        self.addParam("Other", PRODUCT, ParamTypes.Required)


class take(PrimitiveBase):
    def createDescription(self):
        self.setDescription(Take(), "take")

    def execute(self):
        self.params["Taken"].value = self.params["Other"].value
        return self.success(f"{self.params['Taken'].value.label}")


class Task(SkillDescription):
    def createDescription(self):
        self.addParam("A", LOCATION, ParamTypes.Required)
        self.addParam("B", LOCATION, ParamTypes.Required)
        self.addParam("Object", PRODUCT, ParamTypes.Required)
        self.addParam("Unset", PRODUCT, ParamTypes.Optional)


class task(SkillBase):
    def createDescription(self):
        self.setDescription(Task(), "task")

    def expand(self, skill):
        expand(self, skill, '''{tree}''')
"""
TREES = [
    ("See(), See(A=params.B)", True, ["bench shelf", "bench shelf"]),
    ("See(A=params.B, B=params.A)", True, ["bench shelf"]),
    ("See(A=params.A, B=params.A)", True, ["bench shelf"]),
    ("Find(), Find()", False, ["found"]),
    ("Find(), self.nofail(Find()), Look(Object=params.Unset)", True, ["found", "nothing"]),
    ("Look(), Remove(), Look(), See()", True, ["nut", "removed", "nothing", "bench shelf"]),
    (
        "Take(Taken=params.Unset, Other=params.Object), Look(Object=params.Unset)",
        True,
        ["nut", "nut"],
    ),
    ("Take(Other=params.Object), Look(Object=params.Unset)", True, ["nut", "nothing"]),
    ("Look(Object=params.Unset), Look()", True, ["nothing", "nut"]),
]
"""Trees, whether they succeed in SkiROS2, and what is reported there by those that succeed."""


IDS = [tree for tree, _, _ in TREES]
PRIMITIVES = ("see", "find", "remove", "look", "take")


def skills(tree: str) -> str:
    """The skills in EzSkiROS, among them `Task` with these children."""
    return SKILLS.replace("{tree}", tree)


def native_skills(tree: str) -> str:
    """The same for SkiROS2."""
    return NATIVE.replace("{tree}", tree)
