"""The world model: what follows from its facts, and what changes push out."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.engine.scenes import load_world
from ezskiros.engine.world import World
from support.ontologies import START, turtle

ONTOLOGY = """
:Place a owl:Class . :Shelf a owl:Class ; rdfs:subClassOf :Place . :Box a owl:Class .
:at a owl:ObjectProperty , owl:FunctionalProperty .
:parkedAt a owl:ObjectProperty ; rdfs:subPropertyOf :at .
:hosts a owl:ObjectProperty ; owl:inverseOf :at .
:holds a owl:ObjectProperty , owl:InverseFunctionalProperty .
:heldBy a owl:ObjectProperty ; owl:inverseOf :holds .
:near a owl:ObjectProperty , owl:SymmetricProperty .
:partOf a owl:ObjectProperty , owl:TransitiveProperty .
:size a owl:DatatypeProperty ; rdfs:range xsd:float .
:width a owl:DatatypeProperty ; rdfs:subPropertyOf :size .
"""
SCENE = """\
@prefix : <http://example.org/test.owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
:Shelf-1 a :Shelf ; rdfs:label "left" .
:Shelf-2 a :Shelf ; rdfs:label "right" .
:Box-3 a :Box ; rdfs:label "red box" ; :size 2.5 ; :at :Shelf-1 .
"""
SHELF_1, SHELF_2, BOX = (START + name for name in ("Shelf-1", "Shelf-2", "Box-3"))


def iri(name: str) -> str:
    return START + name


@pytest.fixture
def world(tmp_path: Path) -> World:
    scene = tmp_path / "lab.turtle"
    scene.write_text(SCENE, encoding="utf-8")
    found, wrong = load_world(turtle(ONTOLOGY), scene)
    assert wrong == []
    return found


def test_individuals_are_of_their_classes_and_those_above(world: World) -> None:
    assert world.individuals(iri("Place")) == [SHELF_1, SHELF_2]
    assert world.is_a(SHELF_1, iri("Place"))
    assert not world.is_a(BOX, iri("Place"))


def test_a_relation_follows_from_special_cases_inverses_and_symmetry(world: World) -> None:
    world.relate(SHELF_2, iri("hosts"), BOX)
    assert world.related(BOX, iri("at")) == [SHELF_2]
    world.relate(BOX, iri("parkedAt"), SHELF_1)
    assert world.are_related(BOX, iri("at"), SHELF_1)
    world.relate(SHELF_1, iri("near"), SHELF_2)
    assert world.are_related(SHELF_2, iri("near"), SHELF_1)
    assert world.relating(iri("near"), SHELF_1) == [SHELF_2]


def test_a_transitive_relation_is_followed_even_in_a_circle(world: World) -> None:
    world.relate(BOX, iri("partOf"), SHELF_1)
    world.relate(SHELF_1, iri("partOf"), SHELF_2)
    assert world.are_related(BOX, iri("partOf"), SHELF_2)
    assert world.relating(iri("partOf"), SHELF_2) == sorted([BOX, SHELF_1])
    world.relate(SHELF_2, iri("partOf"), BOX)
    assert world.related(BOX, iri("partOf")) == sorted([BOX, SHELF_1, SHELF_2])


@pytest.mark.parametrize("relation", ["at", "parkedAt"])
def test_a_functional_relation_pushes_out_the_old_value(world: World, relation: str) -> None:
    world.relate(BOX, iri(relation), SHELF_2)
    assert world.related(BOX, iri("at")) == [SHELF_2]


def test_a_functional_relation_pushes_out_what_is_said_by_its_inverse(world: World) -> None:
    world.relate(SHELF_2, iri("hosts"), BOX)
    world.relate(BOX, iri("at"), SHELF_1)
    assert not world.are_related(SHELF_2, iri("hosts"), BOX)
    assert world.related(BOX, iri("at")) == [SHELF_1]


def test_an_inverse_functional_relation_pushes_out_the_other_subject(world: World) -> None:
    world.relate(SHELF_1, iri("holds"), BOX)
    world.relate(SHELF_2, iri("holds"), BOX)
    assert world.relating(iri("holds"), BOX) == [SHELF_2]


def test_the_inverse_of_what_is_functional_is_so_too(world: World) -> None:
    world.relate(BOX, iri("heldBy"), SHELF_1)
    world.relate(BOX, iri("heldBy"), SHELF_2)
    assert world.relating(iri("holds"), BOX) == [SHELF_2]


def test_unrelate_takes_away_what_a_relation_follows_from(world: World) -> None:
    world.relate(BOX, iri("parkedAt"), SHELF_1)
    world.unrelate(BOX, iri("at"), SHELF_1)
    assert world.related(BOX, iri("at")) == []


def test_values_are_set_and_taken_away_with_their_special_cases(world: World) -> None:
    assert world.values(BOX, iri("size")) == [2.5]
    world.set_value(BOX, iri("width"), 1.5)
    assert sorted(map(float, world.values(BOX, iri("size")))) == [1.5, 2.5]
    world.set_value(BOX, iri("size"), 3.0)
    assert world.values(BOX, iri("size")) == [3.0]
    world.unset(BOX, iri("size"))
    assert world.values(BOX, iri("size")) == []


def test_a_new_individual_has_a_number_that_no_other_has(world: World) -> None:
    made = world.new(iri("Box"))
    assert made == iri("Box-4")
    assert world.individuals(iri("Box")) == [BOX, made]


def test_numbers_of_individuals_are_in_order(world: World) -> None:
    for _ in range(10):
        world.new(iri("Box"))
    numbers = [int(each.rpartition("-")[2]) for each in world.individuals(iri("Box"))]
    assert numbers == sorted(numbers)
    assert numbers[-1] >= 10


def test_what_is_removed_is_named_nowhere(world: World) -> None:
    world.remove(SHELF_1)
    assert not world.exists(SHELF_1)
    assert world.related(BOX, iri("at")) == []


def test_individuals_have_several_names(world: World) -> None:
    assert world.named("test:Box-3") == world.named(BOX) == world.named("red box") == [BOX]
    assert world.named("nothing like it") == world.named("test:Box-9") == []


def test_what_is_saved_is_a_scene_with_the_same_facts(world: World, tmp_path: Path) -> None:
    world.relate(BOX, iri("at"), SHELF_2)
    saved = tmp_path / "saved.turtle"
    saved.write_text(world.turtle())
    again, wrong = load_world(world.ontology, saved)
    assert wrong == []
    assert again.related(BOX, iri("at")) == [SHELF_2]
    assert again.label(BOX) == "red box"
    twice = tmp_path / "twice.turtle"
    twice.write_text(again.turtle())
    assert twice.read_bytes() == saved.read_bytes()
