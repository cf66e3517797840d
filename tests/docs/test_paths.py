"""Files that the pages for contributors name exist."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = ("ARCHITECTURE.md", "CONTRIBUTING.md")
FILE = re.compile(r"`([\w./-]+/[\w.-]+\.(?:py|md|c|h|lark|toml|j2|ross))`")
# Where a path may begin.
STARTS = (ROOT, ROOT / "src", ROOT / "src" / "ezskiros", ROOT / "src" / "rossmarie")


@pytest.mark.parametrize("page", PAGES)
def test_files_that_a_page_names_exist(page: str) -> None:
    named = set(FILE.findall((ROOT / page).read_text(encoding="utf-8")))
    named.discard("catalog/pages/ROSSnnn.md")
    assert named
    missing = [
        name for name in sorted(named) if not any((start / name).exists() for start in STARTS)
    ]
    assert missing == []


@pytest.mark.parametrize("page", PAGES)
def test_modules_that_a_page_runs_exist(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    for module in re.findall(r"python -m (rossmarie[\w.]*)", text):
        assert (ROOT / "src" / Path(*module.split("."))).with_suffix(".py").exists(), module
