"""Conditions in a world: whether they hold, and that they can be made to."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as some

from ezskiros.engine.conditions import holds, make, reason
from ezskiros.engine.world import World
from ezskiros.ontology.statements import (
    AnyOf,
    Generated,
    HasProperty,
    OfType,
    Relation,
    Specified,
    Statement,
    ValueComparison,
)
from support.ontologies import START, turtle

ONTOLOGY = turtle(
    """
    :Box a owl:Class . :Red a owl:Class ; rdfs:subClassOf :Box .
    :at a owl:ObjectProperty , owl:FunctionalProperty . :near a owl:ObjectProperty .
    :size a owl:DatatypeProperty ; rdfs:range xsd:float .
    :state a owl:DatatypeProperty ;
        rdfs:range [ a rdfs:Datatype ; owl:oneOf ( "Empty" "Full" ) ] .
    """
)
AT, NEAR, SIZE, STATE = (START + name for name in ("at", "near", "size", "state"))


@pytest.fixture
def world() -> World:
    return new_world()


def new_world() -> World:
    found = World(ONTOLOGY)
    for _ in "AB":
        found.new(START + "Box")
    return found


BOUND = {"A": START + "Box-1", "B": START + "Box-2"}


def test_of_what_is_not_specified_only_the_opposite_holds(world: World) -> None:
    for is_true in (True, False):
        for said in (Relation("A", AT, "X", is_true), HasProperty("X", SIZE, is_true)):
            assert holds(said, BOUND, world) is not is_true
    assert holds(Specified("A"), BOUND, world)
    assert not holds(Specified("X"), BOUND, world)


def test_properties_compare_as_written(world: World) -> None:
    world.set_value(BOUND["A"], SIZE, 2.0)
    for sign, value, is_so in [("<", 3.0, True), ("<", 2.0, False), (">=", 2.0, True)]:
        assert holds(ValueComparison("A", SIZE, sign, value), BOUND, world) is is_so
        assert (
            holds(ValueComparison("A", SIZE, sign, value, is_true=False), BOUND, world) is not is_so
        )
    assert not holds(ValueComparison("A", SIZE, "<", "much"), BOUND, world)


def test_an_abstract_relation_is_one_of_classes(world: World) -> None:
    said = Relation("A", NEAR, "B", is_abstract=True)
    assert not holds(said, BOUND, world)
    world.relate(START + "Box", NEAR, START + "Box")
    assert holds(said, BOUND, world)


names = some.sampled_from("AB")
truths = some.booleans()
values = some.sampled_from([-1.0, 0.0, 2.5])
simple = some.one_of(
    some.builds(Relation, names, some.sampled_from([AT, NEAR]), names, truths),
    some.builds(ValueComparison, names, some.just(SIZE),
                some.sampled_from(["=", "<", ">", "<=", ">="]), values, truths),
    some.builds(HasProperty, names, some.sampled_from([SIZE, STATE]), truths),
    some.builds(OfType, names, some.just(START + "Red")),
    some.builds(Generated, names, some.just(True)),
)  # fmt: skip
statements = some.one_of(
    simple, some.builds(AnyOf, some.lists(simple, min_size=1, max_size=3).map(tuple))
)


@given(before=some.lists(statements, max_size=4), said=statements)
def test_what_is_made_holds(before: list[Statement], said: Statement) -> None:
    world = new_world()
    for each in [*before, said]:
        make(each, BOUND, world)
    assert holds(said, BOUND, world)


def test_an_individual_that_is_not_to_be_there_goes(world: World) -> None:
    make(Generated("A", is_true=False), BOUND, world)
    assert not world.exists(BOUND["A"])


def test_none_of_several_holds_any_more(world: World) -> None:
    parts = (Relation("A", NEAR, "B"), HasProperty("A", SIZE))
    for each in parts:
        make(each, BOUND, world)
    make(AnyOf(parts, is_true=False), BOUND, world)
    assert not any(holds(each, BOUND, world) for each in parts)


def test_some_value_is_one_that_the_property_can_have(world: World) -> None:
    make(HasProperty("A", STATE), BOUND, world)
    assert world.values(BOUND["A"], STATE) == ["Empty"]


def test_reasons_say_what_the_world_says(world: World) -> None:
    assert reason(Relation("A", AT, "B"), BOUND, world) == (
        "A is test:Box-1; B is test:Box-2; A test:at nothing"
    )
    world.set_value(BOUND["A"], SIZE, 4.0)
    assert reason(ValueComparison("A", SIZE, "<", 3.0), BOUND, world) == (
        "A is test:Box-1; A test:size: 4.0"
    )
    assert reason(Relation("A", AT, "X"), BOUND, world) == (
        "A is test:Box-1; X has no value; A test:at nothing"
    )
    assert (
        reason(OfType("A", START + "Red"), BOUND, world)
        == "A is test:Box-1; A has the classes test:Box"
    )
