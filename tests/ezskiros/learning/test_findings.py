"""Findings of a check: at the skills of the files, with the places where it happened."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from dslkit.diagnostics import Diagnostic
from ezskiros.learning.findings import findings
from ezskiros.learning.lessons import Lessons, Places, Share, SkillFailure, Trip
from support.tree_files import checked_text

SKIROS = "http://rvmi.aau.dk/ontologies/skiros.owl#"
SKILL = """
class Drive(SkillDescription):
    def description(self, Robot: cora.Robot, Target: skiros.Location):
        self.{kind}_conditions += Robot.at(Target)


class drive(Drive.SkillBase):
    def execute(self):
        return self.success("there")
"""


def at(number: int) -> Places:
    return (("Target", f"{SKIROS}Location-{number}"),)


def trip(skill: str | None, places: Mapping[Places, Share]) -> Trip:
    return Trip("tilting", skill, Share(4, 9), 5, 2.0, {}, places, "tilt = 9 deg")


def found(
    folder: Path, kind: str, *trips: Trip, failures: Sequence[SkillFailure] = ()
) -> list[Diagnostic]:
    lessons = Lessons(9, trips, failures, [], [])
    return list(findings(lessons, checked_text(SKILL.format(kind=kind), folder).library))


@pytest.mark.parametrize(
    ("kind", "said"),
    [
        ("pre", "its description has no hold-condition"),
        ("hold", "its hold-conditions did not end the skill before"),
    ],
)
def test_a_finding_says_how_it_is_with_hold_conditions(
    kind: str, said: str, tmp_path: Path
) -> None:
    (wrong,) = found(tmp_path, kind, trip("Drive", {}))
    assert wrong.title == "`tilting` became active during `Drive` in 4 of 9 runs"
    assert wrong.primary.span.text == "Drive"
    assert wrong.notes == ("the first evidence of the rule: tilt = 9 deg", said)


def test_the_places_with_the_most_runs_are_named(tmp_path: Path) -> None:
    """Three at the most; none at which it did not happen, and none that is no place."""
    many = {at(number): Share(2, 4) for number in range(5)}
    (wrong,) = found(tmp_path, "pre", trip("Drive", many))
    assert wrong.notes[1:-1] == tuple(
        f"with Target = skiros:Location-{number} in 2 of 4 runs" for number in range(3)
    )
    few = {at(1): Share(1, 1), (): Share(1, 2), at(2): Share(0, 5)}
    (wrong,) = found(tmp_path, "pre", trip("Drive", few))
    assert wrong.notes[1:-1] == ("with Target = skiros:Location-1 in 1 of 1 run",)


def test_other_skills_are_left_alone(tmp_path: Path) -> None:
    failures = [
        SkillFailure("Drive", Share(1, 9), "blocked"),
        SkillFailure("Fly", Share(1, 9), "no wings"),
    ]
    said = found(tmp_path, "pre", trip(None, {}), trip("Fly", {}), failures=failures)
    assert [each.title for each in said] == ["`Drive` failed in 1 of 9 runs"]
    assert said[0].notes == ("the most frequent reason: blocked",)
