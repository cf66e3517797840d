"""The tests on the cheat sheet pass; other tests check its blocks, its words and its length."""

from __future__ import annotations

from pathlib import Path

from support.command_line import run
from support.markdown import blocks
from support.rule_skills import put_skills

SHEET = Path(__file__).parents[2] / "docs" / "reference" / "cheat-sheet.md"


def test_the_tests_on_the_sheet_pass(tmp_path: Path) -> None:
    put_skills(tmp_path)
    for block in blocks(SHEET.read_text(encoding="utf-8")):
        if block.language == "ross":
            (tmp_path / block.name).write_text(block.text, encoding="utf-8")
    done = run("rossmarie", "test", tmp_path / "sheet_tests.ross")
    assert "1 test passed, 0 failed" in done.stdout
