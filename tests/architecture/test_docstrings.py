"""Docstrings and comments begin with their subject or a verb."""

from __future__ import annotations

import ast
import re
import tokenize
from collections.abc import Iterator
from pathlib import Path

SRC = Path(__file__).parents[2] / "src"
COPIED = SRC / "rossmarie/targets/python/parts.py"
"""Its docstrings stand in generated modules, which stay as they are."""

CLAUSE = re.compile(r"(What|Whether|How|Which)\b")


def files() -> list[Path]:
    return sorted(set(SRC.rglob("*.py")) - {COPIED})


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


def test_what_is_copied_is_there() -> None:
    assert COPIED.exists()
