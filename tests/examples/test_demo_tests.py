"""The tests of the demo, written by hand and generated: what is there is what comes out."""

from __future__ import annotations

from pathlib import Path

from rossmarie.driver.testing import run_test_file
from support.generated import generated_tests

DEMO = Path(__file__).parents[2] / "examples" / "demo" / "demo.ross"


def test_the_generated_tests_are_those_beside_the_rules(bless: bool) -> None:
    written = generated_tests(DEMO)
    beside = DEMO.with_suffix(".tests.ross")
    if bless:
        beside.write_text(written, encoding="utf-8")
    assert beside.read_text(encoding="utf-8") == written


def test_they_pass_and_cover_everything() -> None:
    found = run_test_file(DEMO)
    assert [one.title for ran in found.ran for one in ran.found] == []
    assert set(found.coverage.goals) - found.coverage.reached == set()
