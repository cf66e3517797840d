"""The pages of what BehaviorTree.CPP cannot say: their examples are exported."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros import catalog
from ezskiros.drawing.btcpp import export
from support.markdown import blocks
from support.tree_files import checked

PAGES = sorted((Path(catalog.__file__).parent / "pages").glob("EZS83*.md"))

OF_CHECKS = ("EZS541", "EZS546")
"""Codes that the check already reports for the examples."""


@pytest.mark.parametrize("heading", ["Example", "Write instead"])
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_example_has_the_finding(page: Path, heading: str, tmp_path: Path) -> None:
    (block,) = (each for each in blocks(page.read_text("utf-8")) if each.heading == heading)
    path = tmp_path / "skill.py"
    path.write_text(block.text, encoding="utf-8")
    found = checked(path)
    assert [str(each) for each in found.diagnostics if each.code not in OF_CHECKS] == []
    trees = [tree for tree in found.trees if tree.implementation == "task"]
    _, said = export(trees, found.trees, found.library, depth=1)
    assert {each.code for each in said} == ({page.stem} if heading == "Example" else set())
