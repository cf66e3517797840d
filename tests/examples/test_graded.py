"""The example of graded reactions: nothing is found, its tests pass, categories select in it."""

from __future__ import annotations

from pathlib import Path

from rossmarie.driver import check_file
from rossmarie.driver.testing import run_test_file
from rossmarie.ir import Category

RULES = Path(__file__).parents[2] / "examples" / "human" / "graded.ross"


def test_nothing_is_found() -> None:
    assert [one.title for one in check_file(RULES).diagnostics] == []


def test_its_tests_pass() -> None:
    found = run_test_file(RULES)
    assert [one.title for ran in found.ran for one in ran.found] == []
    assert len(found.ran) == 5


def test_norms_are_reported_from_the_task() -> None:
    program = check_file(RULES, only=[Category.TASK_INDEPENDENT]).program
    assert program is not None
    assert [rule.name.text for rule in program.rules if rule.name is not None] == [
        "near_person",
        "beside_person",
        "contact",
    ]
