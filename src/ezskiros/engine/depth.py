"""The depth of trees, which may exceed Python's default recursion limit."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

MOST_DEPTH = 2000
"""The most levels of a tree, including those of the compounds in it."""
_FRAMES = 4
"""The maximum number of Python frames per level."""


class TooDeepError(Exception):
    """A tree has more than `MOST_DEPTH` levels."""


@contextmanager
def deep() -> Iterator[None]:
    """While the context is active, Python's recursion limit fits the depth of trees."""
    before = sys.getrecursionlimit()
    sys.setrecursionlimit(before + MOST_DEPTH * _FRAMES)
    try:
        yield
    finally:
        sys.setrecursionlimit(before)
