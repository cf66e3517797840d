"""Files and functions stay small enough to be read at once."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
FOLDERS = ("src", "tests", "examples", "benchmarks", "tools")

MOST_LINES_OF_A_FILE = 400
MOST_LINES_OF_A_FUNCTION = 60

# What is larger, and why that is right: the path, or the path and the function.
EXCEPTIONS: dict[str, str] = {}


@cache
def too_large() -> Mapping[str, int]:
    """All files and functions that are too large, with their lines."""
    return dict(_too_large())


def _too_large() -> Iterator[tuple[str, int]]:
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*.py")):
            name = path.relative_to(ROOT).as_posix()
            text = path.read_text(encoding="utf-8")
            lines = text.count("\n")
            if lines > MOST_LINES_OF_A_FILE:
                yield name, lines
            for node in ast.walk(ast.parse(text)):
                if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
                    length = (node.end_lineno or node.lineno) - node.lineno + 1
                    if length > MOST_LINES_OF_A_FUNCTION:
                        yield f"{name} {node.name}", length


def test_files_and_functions_are_within_their_budget() -> None:
    assert {name: lines for name, lines in too_large().items() if name not in EXCEPTIONS} == {}


def test_exceptions_are_needed_and_reasoned() -> None:
    assert EXCEPTIONS.keys() <= too_large().keys()
    assert all(EXCEPTIONS.values())
