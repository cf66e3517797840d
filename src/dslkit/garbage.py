"""Less frequent garbage collection, because a command creates many objects at its start and keeps
nearly all of them.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

_NEW_OBJECTS = 50_000
"""The number of new objects between two collections. With Python's default, below a thousand, a
short run spends a tenth of its time on collections.
"""


def look_seldom() -> None:
    """Collect garbage less often from now on. The collection still frees cycles in time."""
    gc.set_threshold(_NEW_OBJECTS)


def look_no_more() -> None:
    """Exclude all present objects from garbage collection. The system frees them when the process
    ends.
    """
    gc.freeze()


@contextmanager
def not_now() -> Iterator[None]:
    """While the context is active, do not collect. Use it if most new objects are needed, or if a
    later collection is soon enough.
    """
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()
