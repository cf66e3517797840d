"""The order of test files in a run: what takes long begins early, live tests beside what computes.

Workers of pytest-xdist take whole files in this order (`--dist loadfile`). A live test mostly waits
and leaves its processor to others, so every second file is a live one as long as there are any.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain, groupby, zip_longest

import pytest

LIVE = "tests/live/"
LONG = (
    "tests/property/",
    "tests/docs/test_examples.py",
    "tests/mutation/",
    "tests/rossmarie/verification/",
    "tests/heron/",
    "tests/rossmarie/cli/",
    "tests/ezskiros/",
)
"""The files with long tests, the longest first."""


def arranged(items: Iterable[pytest.Item]) -> list[pytest.Item]:
    """The same tests; those of a file stay together, in their order."""
    files = {name: list(tests) for name, tests in groupby(items, _file)}
    live = [name for name in files if name.startswith(LIVE)]
    others = sorted((name for name in files if name not in live), key=_rank)
    names = (name for pair in zip_longest(live, others) for name in pair if name)
    return list(chain.from_iterable(files[name] for name in names))


def _file(item: pytest.Item) -> str:
    return item.nodeid.partition("::")[0]


def _rank(name: str) -> int:
    """The place of a file's folder among the long ones; behind them all others."""
    return next((n for n, start in enumerate(LONG) if name.startswith(start)), len(LONG))
