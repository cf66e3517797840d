"""Rules files with the findings that they are expected to have, through the whole check."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from support.checking import compare_file, useless_fixes

FIXTURES = Path(__file__).parents[1] / "fixtures"
FILES = sorted(FIXTURES.rglob("*.ross"))


def name(path: Path) -> str:
    return path.relative_to(FIXTURES).as_posix()


@pytest.mark.parametrize("path", FILES, ids=name)
def test_findings_are_as_expected(path: Path, bless: bool) -> None:
    problems = compare_file(path, bless=bless)
    assert not problems, "\n".join(problems)


@pytest.mark.parametrize("path", FILES, ids=name)
def test_fixes_remove_what_they_fix(path: Path, tmp_path: Path) -> None:
    shutil.copytree(path.parent, tmp_path, dirs_exist_ok=True)
    problems = useless_fixes(tmp_path / path.name)
    assert not problems, "\n".join(problems)
