"""The listings of the thesis: what is wrong with them as printed, and that it is all corrected."""

from __future__ import annotations

from pathlib import Path

import pytest

from dslkit.diagnostics import Diagnostic, apply_edits
from rossmarie.driver import check_file

LISTINGS = Path(__file__).parents[3] / "examples" / "thesis"

ARM = [
    ("ROSS302", "max_force"),
    ("ROSS202", "torque"),
    ("ROSS301", "max_torque"),
    ("ROSS402", "force"),
    ("ROSS402", "torque"),
]
MOBILE_BASE = [
    ("ROSS203", "reasonabletilt"),
    ("ROSS203", "maxtilt"),
    ("ROSS401", "maxspeedExceeded"),
    ("ROSS101", "linearSpeed"),
    ("ROSS101", "linearSpeed"),
    ("ROSS101", "minSpeed"),
    ("ROSS102", "imuSensorsystem"),
    ("ROSS102", "imuSensorsystem"),
    ("ROSS402", "orientation"),
]
PEG_IN_HOLE = [
    ("ROSS101", "volume_1"),
    ("ROSS101", "distToObject"),
    ("ROSS402", "contactRichTask"),
    ("ROSS402", "distToOject"),
    ("ROSS402", "eePose"),
    ("ROSS402", "eeInertia"),
]


def findings(name: str) -> tuple[Diagnostic, ...]:
    return check_file(LISTINGS / f"{name}.ross").diagnostics


def finding(name: str, code: str, words: str) -> Diagnostic:
    return next(
        one
        for one in findings(f"{name}_as_printed")
        if (one.code, one.primary.span.text) == (code, words)
    )


@pytest.mark.parametrize(
    ("name", "expected"),
    [("arm", ARM), ("mobile_base", MOBILE_BASE), ("peg_in_hole", PEG_IN_HOLE)],
)
def test_printed_listing_has_exactly_these_findings(
    name: str, expected: list[tuple[str, str]]
) -> None:
    found = [(one.code, one.primary.span.text) for one in findings(f"{name}_as_printed")]
    assert sorted(found) == sorted(expected)


@pytest.mark.parametrize("name", ["arm", "mobile_base", "peg_in_hole", "system"])
def test_corrected_listing_has_no_finding(name: str) -> None:
    assert findings(name) == ()


def test_rate_of_a_force_against_a_force_names_both_ways_out() -> None:
    found = finding("arm", "ROSS302", "max_force")
    assert [label.span.text for label in found.labels] == ["-15 N/sec", "force.z", "Wrench.force"]
    assert found.help == "write a value in N, or compare the rate of change, `rate(force.z)`"
    assert found.fix is not None
    assert [(edit.span.text, edit.replacement) for edit in found.fix.edits] == [("N/sec", "N")]


def test_angular_velocity_against_torque_shows_where_both_units_come_from() -> None:
    found = finding("arm", "ROSS301", "max_torque")
    assert "N*m (mass*length^2/time^2)" in found.primary.text
    assert [label.text for label in found.labels] == [
        "`max_torque` is declared here",
        "this is in rad/s (angle/time)",
        "`torque` is geometry_msgs/Twist.angular",
    ]


def test_number_as_range_is_fixed_in_the_declaration() -> None:
    found = finding("mobile_base", "ROSS203", "reasonabletilt")
    assert found.fix is not None
    fixed = apply_edits(found.primary.span.file.text, found.fix.edits)
    assert "const reasonabletilt = [-10, 10] deg" in fixed


@pytest.mark.parametrize(
    ("name", "code", "words", "meant"),
    [
        ("mobile_base", "ROSS102", "imuSensorsystem", "imuSensorSystem"),
        ("peg_in_hole", "ROSS101", "volume_1", "volume_2"),
        ("peg_in_hole", "ROSS101", "distToObject", "distToOject"),
    ],
)
def test_misspelt_name_points_to_the_declaration(
    name: str, code: str, words: str, meant: str
) -> None:
    found = finding(name, code, words)
    assert found.help == f"did you mean `{meant}`?"
    assert [label.span.text for label in found.labels] == [meant]
    assert found.fix is not None
    assert found.fix.edits[0].replacement == meant
