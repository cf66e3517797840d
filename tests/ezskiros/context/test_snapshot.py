"""Snapshots: the message about running skills as plain data."""

from __future__ import annotations

import math
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pytest

from dslkit.source import SourceFile, Span
from ezskiros.context.snapshot import Snapshots, plain
from ezskiros.engine.ahead import Ahead
from ezskiros.engine.task import Task
from ezskiros.skills.interface import SkillInterface
from support.engine import Skills

SOURCE = """
class Mode(enum.Enum):
    FAST = 1

class Push(SkillDescription):
    def description(
        self,
        Object: skiros.Product,
        Goal: OPTIONAL[skiros.Location],
        Speed: float = 0.25,
        Count: int = 10**400,
        Gently: bool = True,
        How: Mode = Mode.FAST,
        Text: str = "a\\ud800b",
    ):
        self.permits += contact(Object, Goal)
        self.permits += force(Object, "0.02 kN")
        self.permits += closeness(skiros.Container, "3 cm")
        self.permits += speed("36 km/h")

class push(Push.SkillBase):
    def execute(self):
        return self.step("at it")
"""
IMPORTED = "from ezskiros import closeness, contact, force, speed\n"
SCENE = """
skiros:Product-1 a skiros:Product ; skiros:Weight 1.5 .
skiros:Location-2 a skiros:Location , skiros:Container .
"""


def pushing(folder: Path, scene: str = SCENE, *texts: str) -> Task:
    """The task after its first tick."""
    given = texts or ("Object=skiros:Product-1",)
    task, _, _ = Skills(folder, IMPORTED + SOURCE, scene).task("Push", *given)
    task.tick()
    return task


def reported(task: Task) -> dict[str, Any]:
    (only,) = plain(Snapshots("digest").of(task.execution.running, None))["running"]
    assert isinstance(only, dict)
    return only


def test_arguments_have_their_values_types_and_numbers(tmp_path: Path) -> None:
    found = reported(pushing(tmp_path))
    known = {each["parameter"]: each for each in found["arguments"]}
    weight = {"property": "skiros.Weight", "number": 1.5}
    assert known["Object"] == {
        "parameter": "Object",
        "value": "skiros:Product-1",
        "type": "skiros.Product",
        "number": None,
        "properties": [weight],
    }
    shown = {name: (each["value"], each["type"], each["number"]) for name, each in known.items()}
    assert shown["Goal"] == ("", "", None)
    assert shown["Speed"] == ("0.25", "", 0.25)
    assert shown["Count"][1:] == ("", None), "no number of 64 bits"
    assert shown["Gently"] == ("true", "", 1.0)
    assert shown["How"] == ("FAST", "", None)
    assert shown["Text"] == ("a?b", "", None), "text that any encoding has"


def test_permissions_are_those_of_what_it_has(tmp_path: Path) -> None:
    permits = [
        (each["kind"], each["type"], each["limit"])
        for each in reported(pushing(tmp_path))["permits"]
    ]
    assert permits == [
        ("contact", "skiros.Product", None),
        ("force", "skiros.Product", 20.0),
        ("closeness", "skiros.Container", 0.03),
        ("speed", "", 10.0),
    ]


def test_an_individual_has_the_lowest_of_its_classes(tmp_path: Path) -> None:
    given = ("Object=skiros:Product-1", "Goal=skiros:Location-2")
    found = reported(pushing(tmp_path, SCENE, *given))
    types = [each["type"] for each in found["arguments"] if each["parameter"] == "Goal"]
    assert types == ["skiros.Container"]
    assert ("contact", "skiros.Container") in [(p["kind"], p["type"]) for p in found["permits"]]


def test_an_individual_of_two_classes_is_reported_twice(tmp_path: Path) -> None:
    scene = "skiros:Product-1 a skiros:Product , sumo:Device .\n"
    prefix = "@prefix sumo: <http://www.inf.ufrgs.br/phi-group/ontologies/sumo.owl#> .\n"
    found = reported(pushing(tmp_path, prefix + scene))
    types = [each["type"] for each in found["arguments"] if each["parameter"] == "Object"]
    assert types == ["skiros.Product", "sumo.Device"]
    contacts = [each["type"] for each in found["permits"] if each["kind"] == "contact"]
    assert contacts == ["skiros.Product"], "a permission is not for all of either class"


def test_a_property_is_what_it_is_now(tmp_path: Path) -> None:
    task = pushing(tmp_path)
    world = task.execution.world
    skiros = "http://rvmi.aau.dk/ontologies/skiros.owl#"

    def weights() -> list[float | None]:
        (first, *_) = reported(task)["arguments"]
        return [each["number"] for each in first["properties"]]

    world.set_value(skiros + "Product-1", skiros + "Weight", 2.5)
    assert weights() == [2.5]
    world.set_value(skiros + "Product-1", skiros + "Weight", "heavy")
    assert weights() == [None]
    world.unset(skiros + "Product-1", skiros + "Weight")
    assert weights() == []


def test_an_individual_that_is_gone_is_of_the_class_of_the_parameter(tmp_path: Path) -> None:
    task = pushing(tmp_path)
    world = task.execution.world
    world.remove("http://rvmi.aau.dk/ontologies/skiros.owl#Product-1")
    found = reported(task)
    assert found["arguments"][0]["type"] == "skiros.Product"
    kinds = [each["kind"] for each in found["permits"]]
    assert kinds == ["closeness", "speed"], "nothing is permitted with what is not there"


def test_two_snapshots_of_the_same_are_equal(tmp_path: Path) -> None:
    task = pushing(tmp_path)
    snapshots = Snapshots("digest")
    first, second = (snapshots.of(task.execution.running, None) for _ in range(2))
    assert first == second
    assert first.digest == "digest"
    assert math.isnan(asdict(first)["running"][0]["arguments"][0]["number"])


UNITS = """
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
@prefix : <http://example.org/shop.owl#> .
:Nut a owl:Class . :Bolt a owl:Class .
:Mass a owl:DatatypeProperty ; rdfs:domain :Nut ; rdfs:range xsd:float ; :unit "g" .
:Length a owl:DatatypeProperty ; rdfs:domain :Bolt ; rdfs:range xsd:float ; :unit "mm" .
:Colour a owl:DatatypeProperty ; rdfs:range xsd:string .
:Holes a owl:DatatypeProperty ; rdfs:range xsd:int .
"""


def test_properties_are_in_si(tmp_path: Path) -> None:
    ontology = tmp_path / "shop.ttl"
    ontology.write_text(UNITS)
    source = (
        f"shop = load({str(ontology)!r}).shop\n"
        "class Take(SkillDescription):\n    def description(self, Piece: shop.Nut):\n"
        "        pass\nclass take(Take.SkillBase):\n    def execute(self):\n"
        '        return self.step("")\n'
    )
    scene = (
        "@prefix : <http://example.org/shop.owl#> .\n"
        ':Nut-1 a :Nut ; :Mass 250.0 ; :Length 3.0 ; :Colour "red" ; :Holes 2 .'
    )
    task, _, _ = Skills(tmp_path, source, scene).task("Take", "Piece=shop:Nut-1")
    task.tick()
    (argument,) = reported(task)["arguments"]
    assert argument["properties"] == [
        {"property": "shop.Mass", "number": 0.25},
        {"property": "shop.Holes", "number": 2.0},
    ]


@pytest.mark.parametrize(("count", "is_known"), [(64, True), (65, False)])
def test_of_too_many_nobody_says_what_is_ahead(count: int, is_known: bool) -> None:
    """A message with more is read by nobody, and tells of nothing that runs."""
    place = Span(SourceFile("skills.py", ""), 0, 0)
    skills = (SkillInterface(f"Go{number}", place, (), (), (), ()) for number in range(count))
    ahead = [Ahead(each, {}) for each in skills]
    reported = plain(Snapshots("digest").of([], [*ahead, *ahead]))
    assert (len(reported["ahead"]), reported["is_ahead_known"]) == (
        count if is_known else 0,
        is_known,
    )
