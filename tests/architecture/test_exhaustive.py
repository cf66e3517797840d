"""No silent default: mypy's `exhaustive-match` asks each `match` for all members of its subject. A
`case _` that does not raise would answer for those that are still to come; a guard on the last case
keeps mypy from asking.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SOURCES = sorted((ROOT / "src").rglob("*.py"))
OPEN = "# open: "
"""Follows a `case _` over what this project has not declared all members of, and says so."""


def silent_defaults(text: str) -> Iterator[int]:
    """The lines of each `case _` that neither raises nor says that its subject is open."""
    lines = text.splitlines()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.match_case) and is_default(node) and not raises(node):
            line = node.pattern.lineno
            if OPEN not in lines[line - 1]:
                yield line


def guarded_ends(text: str) -> Iterator[int]:
    """The lines of each last case with a guard."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Match) and node.cases[-1].guard is not None:
            yield node.cases[-1].pattern.lineno


def is_default(case: ast.match_case) -> bool:
    return (
        case.guard is None and isinstance(case.pattern, ast.MatchAs) and case.pattern.name is None
    )


def raises(case: ast.match_case) -> bool:
    return isinstance(case.body[-1], ast.Raise)


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(ROOT)))
def test_no_default_is_silent(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert list(silent_defaults(text)) == []
    assert list(guarded_ends(text)) == []


def test_a_silent_default_is_found() -> None:
    text = "match a:\n    case 1:\n        pass\n    case _:{comment}\n        {body}\n"
    assert list(silent_defaults(text.format(comment="", body="x = 1"))) == [4]
    assert list(silent_defaults(text.format(comment="", body="raise ValueError"))) == []
    assert list(silent_defaults(text.format(comment=f"  {OPEN}any", body="x = 1"))) == []


def test_mypy_asks_for_all_members() -> None:
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    assert 'enable_error_code = ["exhaustive-match"]' in text


def test_a_guard_at_the_end_is_found() -> None:
    text = "match a:\n    case 1:\n        pass\n    case 2{guard}:\n        pass\n"
    assert list(guarded_ends(text.format(guard=" if b"))) == [4]
    assert list(guarded_ends(text.format(guard=""))) == []
