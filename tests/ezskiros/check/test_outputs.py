"""Outputs before the skill has run, and keys in findings."""

from __future__ import annotations

import pytest

from support.skill_files import described, found, warned

PARAMETERS = "Place: skiros.Container, Found: OUTPUT[skiros.Product], Other: OUTPUT[skiros.Product]"


@pytest.mark.parametrize(
    "condition",
    [
        "Place.contain(Found)",
        "~Place.contain(Found)",
        "abstract(Place.contain(Found))",
        "Found.Weight < 3.0",
        "Found.Weight",
        "of_type(Found, skiros.Product)",
        "specified(Found)",
        "generated(Found)",
        "~generated(Found)",
        "Place.contain(Place) | specified(Found)",
    ],
)
@pytest.mark.parametrize("kind", ["pre", "hold"])
def test_nothing_is_said_of_an_output_before_the_skill(kind: str, condition: str) -> None:
    result = described(f"self.{kind}_conditions += {condition}", PARAMETERS)
    (only,) = (each for each in result.diagnostics if each.code == "EZS009")
    assert only.primary.span.text == condition
    assert only.title == f"`Found` is an output, and a {kind}-condition uses it"
    assert [label.span.text for label in only.labels] == ["Found"]


def test_each_output_is_reported_once() -> None:
    result = described("self.pre_conditions += Found.spatiallyRelated(Found)", PARAMETERS)
    assert found(result) == [("EZS009", "Found.spatiallyRelated(Found)")]
    result = described("self.pre_conditions += Found.spatiallyRelated(Other)", PARAMETERS)
    assert [each.title for each in result.diagnostics if each.code == "EZS009"] == [
        "`Found` is an output, and a pre-condition uses it",
        "`Other` is an output, and a pre-condition uses it",
    ]


def test_that_there_is_no_output_yet_can_be_said() -> None:
    body = """
    self.pre_conditions += ~specified(Found)
    self.hold_conditions += ~specified(Found)
    self.post_conditions += Place.contain(Found)
    self.post_conditions += specified(Found)
    """
    assert found(described(body, PARAMETERS)) == []


def test_an_output_needs_no_condition() -> None:
    assert warned(described("pass", "Found: OUTPUT[skiros.Product], Weight: OUTPUT[float]")) == []


def test_nothing_is_inferred_from_an_output() -> None:
    parameters = "Place: INFERRED[skiros.Container], Found: OUTPUT[skiros.Product]"
    result = described("self.post_conditions += Place.contain(Found)", parameters)
    assert warned(result) == [("EZS421", "Place")]


ANNOTATED = "__import__('typing').Annotated"


@pytest.mark.parametrize(
    ("parameters", "body", "code"),
    [
        ("Box: {}[skiros.Product, Key('the box')]", "pass", "EZS420"),
        ("Box: {}[INFERRED[skiros.Product], Key('the box')]", "pass", "EZS421"),
        (
            "Box: {}[sumo.Object, Key('the box')], Pose: skiros.GraspingPose",
            "self.pre_conditions += Box.hasA(Pose)",
            "EZS402",
        ),
        (
            "Box: {}[OUTPUT[skiros.Product], Key('the box')]",
            "self.pre_conditions += specified(Box)",
            "EZS009",
        ),
    ],
)
def test_findings_say_the_name_and_the_key(parameters: str, body: str, code: str) -> None:
    result = described(body, parameters.format(ANNOTATED))
    (only,) = (each for each in result.diagnostics if each.code == code)
    assert "Box" in only.title
    assert "`Box` has the key 'the box'" in only.notes


def test_findings_about_others_say_nothing_of_keys() -> None:
    parameters = f"Box: {ANNOTATED}[LOCK[skiros.Product], Key('the box')], Place: skiros.Location"
    (only,) = described("pass", parameters).diagnostics
    assert (only.code, only.primary.span.text, only.notes) == ("EZS420", "Place", ())
