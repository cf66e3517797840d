"""Docstrings and comments begin with their subject or a verb."""

from __future__ import annotations

import ast
import re
import tokenize
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SRC = ROOT / "src"
PLAIN = ("src/rossmarie", "src/dslkit", "src/crosscheck", "benchmarks", "tools")
"""The folders whose docstrings name their subject in the first word."""

CLAUSE = re.compile(r"(What|Whether|How|Which)\b")
ELLIPSIS = re.compile(r"(What|Whether|Which|How|Of|By|From|That|Where|Why|When|Who)\b")


def files() -> list[Path]:
    return sorted(SRC.rglob("*.py"))


def docstrings(path: Path) -> Iterator[tuple[int, str]]:
    """All texts that stand alone as statements: those of attributes are no docstrings to Python."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if (
            isinstance(node, ast.Expr)
            and isinstance(node.value, ast.Constant)
            and isinstance(node.value.value, str)
        ):
            yield node.lineno, node.value.value


def comments(path: Path) -> Iterator[tuple[int, str]]:
    """The first lines of comments that have lines of their own."""
    last = 0
    with path.open("rb") as file:
        for token in tokenize.tokenize(file.readline):
            if token.type == tokenize.COMMENT and token.line.lstrip().startswith("#"):
                line = token.start[0]
                if line != last + 1:
                    yield line, token.string.lstrip("# ")
                last = line


def test_docstrings_and_comments_begin_with_no_clause() -> None:
    found = [
        f"{path.relative_to(SRC)}:{line}: {text.splitlines()[0]}"
        for path in files()
        for line, text in (*docstrings(path), *comments(path))
        if CLAUSE.match(text)
    ]
    assert found == []


@pytest.mark.parametrize("folder", PLAIN)
def test_docstrings_begin_with_their_subject_or_a_verb(folder: str) -> None:
    paths = sorted((ROOT / folder).rglob("*.py"))
    assert paths
    found = [
        f"{path.relative_to(ROOT)}:{line}: {text.splitlines()[0]}"
        for path in paths
        for line, text in docstrings(path)
        if ELLIPSIS.match(text)
    ]
    assert found == []
