"""Skills of EzSkiROS in SkiROS2's own form."""
# ruff: noqa: ARG002, N803

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from dslkit.diagnostics import Collector
from ezskiros import session
from ezskiros.hosts.skiros2_form import Form, FormCondition, FormParameter, form_of
from ezskiros.ontology import Ontology, load
from ezskiros.skills import (
    CONSUME,
    INFERRED,
    LOCK,
    OPTIONAL,
    OUTPUT,
    RESPECT_TYPE,
    UNSPECIFY,
    Key,
    SkillDescription,
    abstract,
    generated,
    of_type,
    specified,
)
from ezskiros.skills.calls import SkillClass
from ezskiros.skills.describe import describe
from support.ontologies import turtle

world = load(Path(__file__).parents[3] / "examples" / "pick_place" / "ontology")
cora, rparts, skiros = world.cora, world.rparts, world.skiros


def form(skill: SkillClass, ontology: Ontology = world) -> Form:
    with session.collecting(Collector()) as found:
        described = describe(skill)
    assert described is not None
    assert not found.sorted()
    return form_of(described.interface, ontology.model)


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


same = turtle(":Hand a owl:Class ; owl:equivalentClass :Gripper . :Gripper a owl:Class .")


def test_a_class_is_the_one_that_is_written() -> None:
    class Use(SkillDescription):
        def description(self, A: same.test.Hand, B: same.test.Gripper) -> None:  # type: ignore[name-defined]
            self.pre_conditions += of_type(A, same.test.Gripper)
            self.pre_conditions += of_type(B, same.test.Hand)

    found = form(Use, same)
    assert [each.type for each in found.parameters[:2]] == ["test:Hand", "test:Gripper"]
    assert [each.arguments for each in found.pre] == [("A", "test:Gripper"), ("B", "test:Hand")]


def test_keys_stand_for_parameters() -> None:
    class Use(SkillDescription):
        def description(
            self,
            Box: Annotated[LOCK[skiros.Product], Key("the box")],  # type: ignore[name-defined]
            Shelf: Annotated[INFERRED[skiros.Location], Key("object-1")],  # type: ignore[name-defined]
            Limit: Annotated[OPTIONAL[float], Key("Time limit (s)")] = 3.5,
        ) -> None:
            self.pre_conditions += Shelf.contain(Box)
            self.pre_conditions += abstract(Shelf.contain(Box))
            self.pre_conditions += Box.Weight < 3
            self.pre_conditions += Box.Weight
            self.post_conditions += of_type(Box, skiros.Product)
            self.post_conditions += specified(Shelf) | generated(Box)

    found = form(Use)
    assert [each.key for each in found.parameters] == [
        "the box",
        "object-1",
        "Time limit (s)",
        "Robot",
    ]
    mentioned = {
        argument
        for each in (*found.pre, *found.hold, *found.post)
        for part in (each.parts or (each,))
        for argument in part.arguments
        if argument in ("the box", "object-1", "Box", "Shelf")
    }
    assert mentioned == {"the box", "object-1"}
    assert found.pre[1].arguments == ("skiros:contain", "object-1", "the box", True)


def test_outputs_are_optional() -> None:
    class Look(SkillDescription):
        def description(self, Found: OUTPUT[skiros.Product], Weight: OUTPUT[float]) -> None:  # type: ignore[name-defined]
            self.post_conditions += Found.Weight

    found = form(Look)
    assert found.parameters[:2] == (
        FormParameter("Found", "Optional", "skiros:Product"),
        FormParameter("Weight", "Optional", "float"),
    )
    assert (found.pre, found.hold) == ((), ())


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
