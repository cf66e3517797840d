"""Fixes leave the program right."""

from __future__ import annotations

from dslkit.diagnostics import apply_edits
from support.programs import check_text

HEAD = """
action stop;
const limit = 20 deg
input imu = topic /imu : sensor_msgs/Imu timeout 1 sec
"""


def fixed(text: str) -> str:
    """The text with the first fix applied."""
    _, found = check_text(text)
    fix = next(finding.fix for finding in found if finding.fix is not None)
    return apply_edits(text, fix.edits)


def test_a_number_used_as_range_and_as_number_keeps_its_declaration() -> None:
    text = fixed(
        HEAD
        + "if imu.orientation.pitch() not in limit or imu.orientation.roll() > limit"
        + " then { stop; };"
    )
    assert "const limit = 20 deg" in text
    assert "not in [-20, 20] deg or" in text
    assert check_text(text)[1] == ()


def test_an_ambiguous_for_gets_the_parentheses_that_it_has_by_precedence() -> None:
    text = fixed(
        HEAD
        + "if imu.orientation.pitch() > limit and imu.orientation.roll() > limit for 2 sec"
        + " then { stop; };"
    )
    assert "limit and (imu.orientation.roll() > limit for 2 sec) then" in text
    assert check_text(text)[1] == ()
