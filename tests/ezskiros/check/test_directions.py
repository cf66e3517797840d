"""Relations that conditions have in both directions, of which the ontology says nothing."""

from __future__ import annotations

from textwrap import indent

import pytest

from ezskiros.driver import Checked
from support.skill_files import HEADER, checked, described_in, warned

PARAMETERS = "Object: skiros.Product, Place: skiros.Container, Robot: cora.Robot"


def skills(*bodies: str) -> Checked:
    """A check of skills with these conditions."""
    text = "".join(
        f"\n\nclass Skill{number}(SkillDescription):\n"
        f"    def description(self, {PARAMETERS}):\n{indent(body, ' ' * 8)}\n"
        for number, body in enumerate(bodies)
    )
    return checked(HEADER + text)


def swapped(*bodies: str) -> list[str]:
    """The conditions that are reported as swapped."""
    return [text for code, text in warned(skills(*bodies)) if code == "EZS422"]


ONCE = "self.pre_conditions += Object.at(Place)"
TURNED = "self.pre_conditions += Place.at(Object)"


@pytest.mark.parametrize(
    ("bodies", "expected"),
    [
        ([ONCE], []),
        ([ONCE, ONCE], []),
        ([ONCE, TURNED], ["Place.at(Object)"]),
        ([TURNED, ONCE], ["Object.at(Place)"]),
        ([TURNED, ONCE, ONCE], ["Place.at(Object)"]),
        ([ONCE, TURNED, TURNED], ["Object.at(Place)"]),
        ([ONCE, "self.post_conditions += ~Place.at(Object)"], ["~Place.at(Object)"]),
        (["self.pre_conditions += Object.at(Place) | Place.at(Object)"], None),
        ([ONCE, "self.pre_conditions += Robot.at(Object)"], []),
        (["self.pre_conditions += Object.at(Object)"], []),
        ([ONCE, "self.pre_conditions += Place.contain(Object)"], []),
    ],
)
def test_the_rarer_direction_is_reported(bodies: list[str], expected: list[str] | None) -> None:
    found = swapped(*bodies)
    assert len(found) == 1 if expected is None else found == expected


def test_the_finding_shows_the_other_direction_and_the_fix() -> None:
    (found,) = [each for each in skills(ONCE, TURNED).diagnostics if each.code == "EZS422"]
    assert [label.span.text for label in found.labels] == ["Object.at(Place)"]
    assert found.help == "if the sides are swapped here, write `Object.at(Place)`"


def test_other_classes_say_nothing_of_a_direction() -> None:
    text = f"""{HEADER}
class Put(SkillDescription):
    def description(self, Object: skiros.Product, Any: sumo.Object, Place: skiros.Location):
        self.pre_conditions += Any.at(Object)
        self.pre_conditions += Object.at(Place)
        self.post_conditions += Object.at(Any)
"""
    assert "EZS422" not in [code for code, _ in warned(checked(text))]


ONTOLOGY = ":One a owl:Class . :Other a owl:Class . :near a owl:ObjectProperty ."


@pytest.mark.parametrize(
    ("added", "expected"), [("", ["B.near(A)"]), (":near a owl:SymmetricProperty .", [])]
)
def test_symmetric_relations_have_no_direction(added: str, expected: list[str]) -> None:
    said = "self.pre_conditions += A.near(B)\nself.post_conditions += B.near(A)"
    result = described_in(ONTOLOGY + added, said, "A: test.One, B: test.Other")
    assert [text for code, text in warned(result) if code == "EZS422"] == expected
