"""Docstrings and comments begin with their subject or a verb, in the rooms that are read for it."""

from __future__ import annotations

import ast
import re
import tokenize
from collections.abc import Iterator
from pathlib import Path

SRC = Path(__file__).parents[2] / "src"
ROOMS = (
    "campaign",
    "dslkit",
    "ezskiros",
    "heron",
    "rossmarie/analysis",
    "rossmarie/check",
    "rossmarie/cli",
    "rossmarie/core",
    "rossmarie/driver",
    "rossmarie/interpreter",
    "rossmarie/ir",
    "rossmarie/lowering",
    "rossmarie/naming",
    "rossmarie/native",
    "rossmarie/recordings",
    "rossmarie/report",
    "rossmarie/syntax",
    "rossmarie/targets",
    "rossmarie/testing",
    "rossmarie/types",
    "rossmarie/units",
    "rossmarie/verification/formulas.py",
    "rossmarie/verification/opaque.py",
)
"""The rooms that are done. Others join them; none leaves."""

COPIED = "rossmarie/targets/python/parts.py"
"""Its docstrings stand in generated modules, which stay as they are."""

CLAUSE = re.compile(r"(What|Whether|How|Which)\b")


def files() -> Iterator[Path]:
    for room in ROOMS:
        path = SRC / room
        yield from sorted(path.rglob("*.py")) if path.is_dir() else [path]


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
        if path != SRC / COPIED
        for line, text in (*docstrings(path), *comments(path))
        if CLAUSE.match(text)
    ]
    assert found == []


def test_every_room_is_there() -> None:
    assert [room for room in ROOMS if not (SRC / room).exists()] == []
    assert (SRC / COPIED).exists()
