"""The whiteboard (Paper II, section 7): wiping it trips no rule, and a real collision does."""

from __future__ import annotations

from pathlib import Path

from crosscheck.check import check_robot
from rossmarie.driver.testing import run_test_file

RULES = Path(__file__).parents[2] / "examples" / "whiteboard" / "whiteboard.ross"


def test_nothing_is_found_in_rules_and_skills() -> None:
    assert [one.title for one in check_robot(RULES)] == []


def test_its_tests_pass() -> None:
    found = run_test_file(RULES)
    assert [one.title for ran in found.ran for one in ran.found] == []
    assert len(found.ran) == 5
