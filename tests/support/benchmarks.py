"""Modules of the benchmarks, which find each other beside them."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@contextmanager
def imported(names: Sequence[str]) -> Iterator[dict[str, Any]]:
    """These modules, until the end of the block."""
    before = set(sys.modules)
    sys.path.insert(0, str(BENCHMARKS))
    try:
        yield {name: importlib.import_module(name) for name in names}
    finally:
        sys.path.remove(str(BENCHMARKS))
        own = {path.stem for path in BENCHMARKS.glob("*.py")}
        for name in own.intersection(set(sys.modules) - before):
            del sys.modules[name]
