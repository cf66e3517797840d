"""Conditions against the ontology, against each other, and what leads to inferred parameters."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.driver import check_paths
from support.ontologies import HALL
from support.skill_files import described, found, warned

INDIVIDUALS = (
    "Object: skiros.Product, Gripper: rparts.GripperEffector, Place: skiros.Container, "
    "Pose: skiros.GraspingPose, Any: sumo.Object"
)


@pytest.mark.parametrize(
    ("expression", "code", "text"),
    [
        ("Object.hasA(Gripper)", "EZS401", "Gripper"),
        ("Gripper.hasA(Pose)", "EZS401", "Gripper"),
        ("~Object.hasA(Gripper)", "EZS401", "Gripper"),
        ("abstract(Object.hasA(Gripper))", "EZS401", "Gripper"),
        ("Gripper.at(Place) | Object.hasA(Gripper)", "EZS401", "Gripper"),
        ("Object.Weight == 'heavy'", "EZS403", "'heavy'"),
        ("Object.Weight == True", "EZS403", "True"),
        ("Place.ContainerState == 'Emtpy'", "EZS404", "'Emtpy'"),
        ("Place.ContainerState < 'Full'", "EZS405", "Place.ContainerState < 'Full'"),
    ],
)
def test_what_does_not_fit_is_reported(expression: str, code: str, text: str) -> None:
    assert found(described(f"self.pre_conditions += {expression}", INDIVIDUALS)) == [(code, text)]


def test_the_message_says_what_the_thesis_says() -> None:
    result = described("self.pre_conditions += Object.hasA(Gripper)", INDIVIDUALS)
    wrong = next(each for each in result.diagnostics if each.code == "EZS401")
    assert wrong.title == (
        "Gripper is a rparts.GripperEffector, but skiros.hasA needs a skiros.TransformationPose"
    )
    declared, property_declared = wrong.labels
    assert declared.span.text == "Gripper"
    assert property_declared.span.text == "skiros:hasA"
    assert Path(property_declared.span.file.path).samefile(HALL / "skiros.ttl")


@pytest.mark.parametrize(
    "expression", ["Object.hasA(Pose)", "Object.Weight < 3", "Place.at(Place)"]
)
def test_what_fits_is_fine(expression: str) -> None:
    result = described(f"self.pre_conditions += {expression}", INDIVIDUALS)
    assert found(result) == []
    assert [code for code, _ in warned(result) if code != "EZS420"] == []


def test_what_may_not_fit_is_a_warning() -> None:
    result = described("self.pre_conditions += Object.hasA(Any)", INDIVIDUALS)
    assert found(result) == []
    assert ("EZS402", "Any") in warned(result)


@pytest.mark.parametrize(
    ("first", "second", "code"),
    [
        ("pre_conditions += Place.at(Pose)", "pre_conditions += Place.at(Pose)", "EZS410"),
        ("pre_conditions += Place.at(Pose)", "pre_conditions += ~Place.at(Pose)", "EZS411"),
        ("hold_conditions += Any.Weight == 3", "hold_conditions += Any.Weight != 3", "EZS411"),
        ("pre_conditions += Any.Weight < 3", "pre_conditions += Any.Weight > 3", "EZS411"),
        ("pre_conditions += Any.Weight < 3", "pre_conditions += Any.Weight >= 3", "EZS411"),
        ("pre_conditions += ~(Any.Weight < 4)", "pre_conditions += Any.Weight <= 3", "EZS411"),
        ("pre_conditions += Place.at(Pose)", "hold_conditions += ~Place.at(Pose)", "EZS411"),
        ("post_conditions += Object.at(Place)", "post_conditions += Object.at(Pose)", "EZS412"),
        ("post_conditions += Place.contain(Object)", "post_conditions += Gripper.contain(Object)",
         "EZS412"),
    ],
)  # fmt: skip
def test_conditions_that_do_not_go_together_are_reported(
    first: str, second: str, code: str
) -> None:
    result = described(f"self.{first}\nself.{second}", INDIVIDUALS)
    reported = [each for each in result.diagnostics if each.code.startswith("EZS41")]
    assert [(each.code, each.primary.span.text) for each in reported] == [
        (code, second.partition("+= ")[2])
    ]
    assert reported[0].labels[0].span.text == first.partition("+= ")[2]


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("pre_conditions += Place.contain(Object)", "post_conditions += ~Place.contain(Object)"),
        ("pre_conditions += Any.Weight <= 3", "pre_conditions += Any.Weight >= 3"),
        ("pre_conditions += Any.Weight > 2", "pre_conditions += Any.Weight < 3"),
        ("pre_conditions += Object.Weight < 2", "pre_conditions += Any.Weight > 3"),
        ("pre_conditions += Place.at(Pose)", "hold_conditions += Place.at(Pose)"),
        ("pre_conditions += Object.at(Place)", "post_conditions += Object.at(Pose)"),
        ("post_conditions += Object.at(Place)", "post_conditions += ~Object.at(Pose)"),
        ("post_conditions += Object.at(Place)", "post_conditions += Gripper.at(Place)"),
    ],
)
def test_conditions_that_go_together_are_fine(first: str, second: str) -> None:
    result = described(f"self.{first}\nself.{second}", INDIVIDUALS)
    assert [each.code for each in result.diagnostics if each.code.startswith("EZS41")] == []


def test_parameters_that_nothing_is_said_of_are_reported() -> None:
    result = described(
        "self.pre_conditions += Place.contain(Object)",
        "Object: skiros.Product, Place: INFERRED[skiros.Container], "
        "Pose: INFERRED[skiros.GraspingPose], Gripper: rparts.GripperEffector, Speed: float = 1.0",
    )
    assert warned(result) == [("EZS421", "Pose"), ("EZS420", "Gripper")]


def test_what_leads_to_a_parameter_has_to_hold_before() -> None:
    body = """
    self.pre_conditions += ~Place.contain(Object)
    self.post_conditions += Place.contain(Object)
    """
    parameters = "Object: skiros.Product, Place: INFERRED[skiros.Container]"
    assert warned(described(body, parameters)) == [("EZS421", "Place")]


def test_listing_5_of_the_thesis_is_fine() -> None:
    result = check_paths([HALL.parent / "skills"])
    assert found(result) == warned(result) == []
    skills = {skill.name: skill for skill in result.skills}
    assert {"Pick", "Place"} <= set(skills)
    assert [each.doc for each in skills["Place"].parameters][-2:] == [
        "the location of the product afterwards.",
        "the speed of the approach, in m/s.",
    ]


def test_the_planted_mistakes_are_found() -> None:
    result = check_paths([HALL.parent / "planted"])
    codes = ["EZS401", "EZS301", "EZS411"]
    assert [each.code for each in result.diagnostics] == codes
