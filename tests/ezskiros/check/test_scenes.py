"""Scenes against the ontology."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.check.scenes import check_scene
from ezskiros.driver import check_paths
from ezskiros.ontology import load
from ezskiros.ontology.load import VARIABLE
from support.ontologies import HALL, PREFIXES, turtle

SCENE = """\
@prefix cora: <http://www.inf.ufrgs.br/phi-group/ontologies/cora.owl#> .
@prefix rparts: <http://www.inf.ufrgs.br/phi-group/ontologies/RParts.owl#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .

skiros:Location-1 a skiros:Location, owl:NamedIndividual ;
    rdfs:label "table" ;
    skiros:contain skiros:Product-2, skiros:Product-3 .

skiros:Product-2 a skiros:Product ;
    skiros:Weight "0.5"^^xsd:float ;
    skiros:hasA skiros:GraspingPose-4 .

skiros:Product-3 a skiros:Product .

skiros:GraspingPose-4 a skiros:GraspingPose .

skiros:Container-5 a skiros:Container ;
    skiros:ContainerState "Empty" .

cora:Robot-6 a cora:Robot ;
    skiros:at skiros:Location-1 .

rparts:GripperEffector-7 a rparts:GripperEffector .
"""


def findings(text: str, path: Path) -> list[tuple[str, str]]:
    scene = path / "scene.turtle"
    scene.write_text(text)
    return [(each.code, each.primary.span.text) for each in check_scene(scene, load(HALL))]


def test_a_scene_that_fits_is_fine(tmp_path: Path) -> None:
    assert findings(SCENE, tmp_path) == []


@pytest.mark.parametrize(
    ("old", "new", "code", "text"),
    [
        ("a skiros:Product ;", "a skiros:Produkt ;", "EZS601", "skiros:Produkt"),
        ("skiros:hasA ", "skiros:hasAA ", "EZS602", "skiros:hasAA"),
        ("skiros:Weight ", "skiros:Weigth ", "EZS602", "skiros:Weigth"),
        ("skiros:at skiros:Location-1", "skiros:at skiros:Location-9", "EZS603",
         "skiros:Location-9"),
        ("hasA skiros:GraspingPose-4", "hasA rparts:GripperEffector-7", "EZS604",
         "rparts:GripperEffector-7"),
        ('"0.5"^^xsd:float', '"heavy"', "EZS605", "skiros:Weight"),
        ('"0.5"^^xsd:float', '"heavy"^^xsd:float', "EZS605", "skiros:Weight"),
        ('"Empty"', '"Emtpy"', "EZS605", "skiros:ContainerState"),
        ("skiros:Weight \"0.5\"^^xsd:float", "skiros:Weight skiros:Product-3", "EZS606",
         "skiros:Weight"),
        ("skiros:at skiros:Location-1", 'skiros:at "table"', "EZS606", "skiros:at"),
        ("cora:Robot-6", "cora:Robot-5", "EZS608", "cora:Robot-5"),
        ("skiros:at skiros:Location-1", "skiros:at skiros:Location-1, skiros:Container-5", "EZS609",
         "cora:Robot-6"),
        ('"Empty" .', '"Empty" ; skiros:contain skiros:Product-3 .', "EZS609",
         "skiros:Container-5"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_reported(
    old: str, new: str, code: str, text: str, tmp_path: Path
) -> None:
    assert old in SCENE
    assert findings(SCENE.replace(old, new), tmp_path) == [(code, text)]


def test_what_each_individual_of_a_class_has_is_missed(tmp_path: Path) -> None:
    ontology = turtle(
        ":Arm a owl:Class . :hasA a owl:ObjectProperty . :Robot a owl:Class ; rdfs:subClassOf\n"
        "[ a owl:Restriction ; owl:onProperty :hasA ; owl:someValuesFrom :Arm ] ."
    )
    scene = tmp_path / "scene.turtle"
    scene.write_text(
        PREFIXES + ":Robot-1 a :Robot ; :hasA :Arm-2 . :Arm-2 a :Arm .\n:Robot-3 a :Robot ."
    )
    (found,) = check_scene(scene, ontology)
    assert (found.code, found.title) == ("EZS607", ":Robot-3 has no relation :hasA to a :Arm")


def test_a_broken_scene_is_reported_at_its_line(tmp_path: Path) -> None:
    scene = tmp_path / "scene.turtle"
    scene.write_text(SCENE.replace("a skiros:Product ;", "a skiros:Product", 1))
    (found,) = check_scene(scene, load(HALL))
    assert (found.code, found.primary.span.begin.line) == ("EZS102", 13)


def test_the_command_takes_scenes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = tmp_path / "scene.turtle"
    scene.write_text(SCENE.replace("skiros:hasA", "skiros:hasAA"))
    monkeypatch.delenv(VARIABLE, raising=False)
    assert [each.code for each in check_paths([scene]).diagnostics] == ["EZS600"]
    monkeypatch.setenv(VARIABLE, str(HALL))
    assert [each.code for each in check_paths([scene]).diagnostics] == ["EZS602"]
    assert [each.code for each in check_paths([tmp_path / "x.turtle"]).diagnostics] == ["EZS001"]
