"""Less frequent garbage collection: a command creates many objects at its start, and keeps nearly
all.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

_NEW_OBJECTS = 50_000
"""The number of new objects between two collections. With Python's own number, below a thousand, a
tenth of a short run is spent on collections.
"""


def look_seldom() -> None:
    """Collect garbage less often from now on. Cycles still do not fill the memory."""
    gc.set_threshold(_NEW_OBJECTS)


def look_no_more() -> None:
    """Exclude all present objects from garbage collection. The system frees them when the process
    ends.
    """
    gc.freeze()


@contextmanager
def not_now() -> Iterator[None]:
    """While the context is active, do not collect: most new objects are needed, or there is time
    later.
    """
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()
