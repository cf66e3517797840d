"""A built-in function is named by the files of the recipe in CONTRIBUTING.md, and by no others."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "src" / "rossmarie"
MOST = 8
"""The maximum number of source files that a new function may touch."""


def recipe() -> set[str]:
    """The files that the recipe names."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    section = text.split("## Recipe: add a built-in function")[1].split("\n## ")[0]
    return set(re.findall(r"`([a-z_/]+\.(?:py|lark))`", section))


@pytest.mark.parametrize("function", ["hypot", "median"])
def test_a_function_stands_in_the_files_of_the_recipe(function: str) -> None:
    named = re.compile(rf"(?i)\b_?{function}(_of)?\b(?<!math\.{function})")
    files = [path for kind in ("py", "lark", "c", "j2") for path in SOURCES.rglob(f"*.{kind}")]
    found = {
        path.relative_to(SOURCES).as_posix()
        for path in files
        if named.search(path.read_text(encoding="utf-8")) and "recordings" not in path.parts
    }
    assert found
    assert found <= recipe()
    assert len(found) <= MOST
