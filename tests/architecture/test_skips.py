"""Tests are skipped for want of a part of the machine only, so that the suite can tell of it."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

TESTS = Path(__file__).parents[1]
SKIPPING = {"importorskip", "skip", "skipif", "SkipTest"}

ALLOWED = {"support/parts.py"}


def skips(path: Path) -> Iterator[str]:
    """The places where a file skips tests with pytest or unittest."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Attribute) and ast.unparse(node.value) in {"pytest", "pytest.mark"}:
            names = [node.attr]
        elif isinstance(node, ast.ImportFrom) and node.module in {"pytest", "unittest"}:
            names = [name.name for name in node.names]
        else:
            continue
        for name in SKIPPING.intersection(names):
            yield f"{path.relative_to(TESTS).as_posix()}:{node.lineno} {name}"


def test_tests_are_skipped_by_parts_only() -> None:
    paths = [path for path in TESTS.rglob("*.py") if not path.is_relative_to(TESTS / "fixtures")]
    found = [where for path in sorted(paths) for where in skips(path)]
    assert [where for where in found if where.partition(":")[0] not in ALLOWED] == []
    assert {where.partition(":")[0] for where in found} == ALLOWED, "the search finds them"
