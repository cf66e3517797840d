"""Inferred parameters that nothing leads to: a warning where several individuals could be meant."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.driver import check_paths
from ezskiros.ontology.load import VARIABLE
from support.ontologies import HALL, PREFIXES

SKILL = """
from ezskiros import INFERRED, SkillDescription
from ezskiros.ontology import load

world = load()


class Grasp(SkillDescription):
    def description(
        self,
        Arm: INFERRED[world.rparts.ArmDevice],
        Place: INFERRED[world.skiros.Location],
        Object: world.skiros.Product,
    ):
        self.pre_conditions += Object.Weight < 3


class grasp(Grasp.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Arm} at {self.params.Place}")
"""
SCENE = """
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix : <http://example.org/lab.turtle#> .
{}
"""


def warned(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *scene: str) -> list[tuple[str, str]]:
    """The parameters that are warned of, and why, with the individuals of a scene."""
    monkeypatch.setenv(VARIABLE, str(HALL))
    skills, lab = tmp_path / "skills.py", tmp_path / "lab.turtle"
    skills.write_text(SKILL)
    lab.write_text(SCENE.format("\n".join(scene)))
    found = check_paths([skills, lab] if scene else [skills]).diagnostics
    assert {each.code for each in found} <= {"EZS421"}
    return [(each.primary.span.text, each.primary.text) for each in found]


def individuals(name: str, *numbers: int) -> list[str]:
    """Individuals of a class of the ontology of the example."""
    prefix, _, kind = name.partition(":")
    start = {"rparts": "http://www.inf.ufrgs.br/phi-group/ontologies/RParts.owl#"}.get(
        prefix, "http://rvmi.aau.dk/ontologies/skiros.owl#"
    )
    return [f":{kind}-{number} a owl:NamedIndividual , <{start}{kind}> ." for number in numbers]


PLACES = ("Place", "SkiROS2 would choose any skiros.Location in the world")


def test_where_nothing_is_known_there_is_one_robot_and_there_are_many_places(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert warned(tmp_path, monkeypatch) == [PLACES]


def test_one_place_in_the_scene_is_the_one_that_is_meant(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert warned(tmp_path, monkeypatch, *individuals("skiros:Location", 1)) == []


def test_places_of_a_class_below_count(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = [*individuals("skiros:Location", 1), *individuals("skiros:Container", 2)]
    ((place, reported),) = warned(tmp_path, monkeypatch, *scene)
    assert place == "Place"
    assert "Container-2" in reported
    assert "Location-1" in reported


def test_a_second_arm_in_the_scene_could_be_meant(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = warned(tmp_path, monkeypatch, *individuals("rparts:ArmDevice", 1, 2))
    assert [name for name, _ in found] == ["Arm", "Place"]
    assert "ArmDevice-1" in found[0][1]
    assert "ArmDevice-2" in found[0][1]


def test_individuals_of_the_ontology_count(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ontology = tmp_path / "robots.ttl"
    ontology.write_text(
        PREFIXES + "@prefix rparts: <http://www.inf.ufrgs.br/phi-group/ontologies/RParts.owl#> .\n"
        ":left a owl:NamedIndividual , rparts:ArmDevice . "
        ":right a owl:NamedIndividual , rparts:ArmDevice ."
    )
    skills = tmp_path / "skills.py"
    skills.write_text(SKILL)
    monkeypatch.setenv(VARIABLE, f"{HALL}:{ontology}")
    found = [each.primary.span.text for each in check_paths([skills]).diagnostics]
    assert found == ["Arm", "Place"]
