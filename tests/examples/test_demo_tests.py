"""The tests of the demo, written by hand and generated: what is there is what comes out."""

from __future__ import annotations

from pathlib import Path

from rossmarie.driver.generating import generate_tests
from rossmarie.driver.testing import run_test_file

DEMO = Path(__file__).parents[2] / "examples" / "demo" / "demo.ross"


def test_the_generated_tests_are_those_beside_the_rules(bless: bool) -> None:
    written = generate_tests(DEMO)
    if bless:
        written.path.write_text(written.text, encoding="utf-8")
    assert written.path.read_text(encoding="utf-8") == written.text


def test_they_pass_and_cover_everything() -> None:
    found = run_test_file(DEMO)
    assert [one.title for ran in found.ran for one in ran.found] == []
    assert set(found.coverage.goals) - found.coverage.reached == set()
