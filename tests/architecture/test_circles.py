"""No module imports itself by way of others: what two need of each other lies below both."""

from __future__ import annotations

from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import grimp
import pytest

SOURCES = Path(__file__).parents[2] / "src"
PACKAGES = sorted(path.parent.name for path in SOURCES.glob("*/__init__.py"))


def imports() -> dict[str, set[str]]:
    """The modules that each module imports: at once, in a function, or for type checkers."""
    graph = grimp.build_graph(*PACKAGES, cache_dir=None)
    return {each: graph.find_modules_directly_imported_by(each) for each in graph.modules}


def test_no_modules_import_each_other() -> None:
    found = imports()
    assert len(found) == len(list(SOURCES.rglob("*.py")))
    try:
        TopologicalSorter(found).prepare()
    except CycleError as problem:
        pytest.fail(" is imported by ".join(problem.args[1]))
