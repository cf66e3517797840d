"""Skills of EzSkiROS in SkiROS2's own form."""
# ruff: noqa: ARG002, N803

from __future__ import annotations

from pathlib import Path

from dslkit.diagnostics import Collector
from ezskiros import session
from ezskiros.hosts.skiros2_form import Form, FormCondition, FormParameter, form_of
from ezskiros.ontology import Ontology, load
from ezskiros.skills import (
    CONSUME,
    INFERRED,
    LOCK,
    OPTIONAL,
    RESPECT_TYPE,
    UNSPECIFY,
    SkillDescription,
    abstract,
    generated,
    of_type,
    specified,
)
from ezskiros.skills.describe import describe

world = load(Path(__file__).parents[3] / "examples" / "pick_place" / "ontology")
cora, rparts, skiros = world.cora, world.rparts, world.skiros


def form(skill: type[SkillDescription]) -> Form:
    with session.collecting(Collector()) as found:
        described = describe(skill)
    assert described is not None
    assert not found.sorted()
    assert isinstance(world, Ontology)
    return form_of(described.interface, world.model)


def test_parameters_have_kinds_types_and_defaults() -> None:
    class Grasp(SkillDescription):
        def description(
            self,
            Robot: INFERRED[cora.Robot],  # type: ignore[name-defined]
            Object: skiros.Product,  # type: ignore[name-defined]
            Place: OPTIONAL[skiros.Location],  # type: ignore[name-defined]
            Relation: str,
            Speed: float = 1,
            Again: OPTIONAL[bool] = False,
        ) -> None:
            pass

    assert form(Grasp).parameters == (
        FormParameter("Robot", "Inferred", "cora:Robot"),
        FormParameter("Object", "Required", "skiros:Product"),
        FormParameter("Place", "Optional", "skiros:Location"),
        FormParameter("Relation", "Required", "str"),
        FormParameter("Speed", "Required", "float", 1.0),
        FormParameter("Again", "Optional", "bool", False),
    )


def test_a_robot_is_added_where_there_is_none() -> None:
    class Nothing(SkillDescription):
        def description(self) -> None:
            pass

    assert form(Nothing) == Form(
        "Nothing", (FormParameter("Robot", "Inferred", "sumo:Agent"),), (), (), ()
    )


def test_options_are_conditions_before_all_others() -> None:
    class Use(SkillDescription):
        def description(
            self,
            A: CONSUME[skiros.Product],  # type: ignore[name-defined]
            B: UNSPECIFY[skiros.Product],  # type: ignore[name-defined]
            C: LOCK[rparts.ArmDevice],  # type: ignore[name-defined]
            D: RESPECT_TYPE[skiros.Product],  # type: ignore[name-defined]
        ) -> None:
            self.pre_conditions += specified(A)

    def state(is_idle: bool) -> FormCondition:
        return FormCondition("getPropCond", ("skiros:StateProperty", "C", "=", "Idle", is_idle))

    found = form(Use)
    assert found.pre == (
        state(True),
        FormCondition("getOnTypeCond", ("D", "skiros:Product")),
        FormCondition("getIsSpecifiedCond", ("A", True)),
    )
    assert found.hold == (state(False),)
    assert found.post == (
        FormCondition("getGenerateCond", ("A", False)),
        FormCondition("getIsSpecifiedCond", ("B", False)),
        state(True),
    )


def test_conditions_are_those_of_skiros2() -> None:
    class All(SkillDescription):
        def description(self, A: rparts.GripperEffector, B: skiros.Product) -> None:  # type: ignore[name-defined]
            self.pre_conditions += A.contain(B)
            self.pre_conditions += ~A.contain(B)
            self.pre_conditions += abstract(A.contain(B))
            self.pre_conditions += A.ContainerState == "Empty"
            self.pre_conditions += A.ContainerState != "Empty"
            self.pre_conditions += ~A.ContainerState
            self.hold_conditions += of_type(B, skiros.Product)
            self.hold_conditions += ~specified(B)
            self.post_conditions += ~generated(B)
            self.post_conditions += ~(A.contain(B) | specified(A) | generated(B))

    found = form(All)
    contained = FormCondition("getRelationCond", ("skiros:contain", "A", "B", True))
    assert found.pre == (
        contained,
        FormCondition("getRelationCond", ("skiros:contain", "A", "B", False)),
        FormCondition("getAbstractRelationCond", ("skiros:contain", "A", "B", True)),
        FormCondition("getPropCond", ("skiros:ContainerState", "A", "=", "Empty", True)),
        FormCondition("getPropCond", ("skiros:ContainerState", "A", "=", "Empty", False)),
        FormCondition("getHasPropCond", ("skiros:ContainerState", "A", False)),
    )
    assert found.hold == (
        FormCondition("getOnTypeCond", ("B", "skiros:Product")),
        FormCondition("getIsSpecifiedCond", ("B", False)),
    )
    parts = (
        contained,
        FormCondition("getIsSpecifiedCond", ("A", True)),
        FormCondition("getGenerateCond", ("B", True)),
    )
    assert found.post == (
        FormCondition("getGenerateCond", ("B", False)),
        FormCondition("getOrCond", (False,), parts),
    )
