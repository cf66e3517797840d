"""Python looks for garbage seldom: a command makes much at its start, and keeps nearly all."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

_NEW_OBJECTS = 50_000
"""Python's own number is below a thousand: then a tenth of a short run goes into looking."""


def look_seldom() -> None:
    """From now on, look after so many new objects. Cycles still do not fill the memory."""
    gc.set_threshold(_NEW_OBJECTS)


def look_no_more() -> None:
    """From now on, what is there stays: the system takes it back when the process ends."""
    gc.freeze()


@contextmanager
def not_now() -> Iterator[None]:
    """Within, do not look at all: most of what is made is needed, or there is time later."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()
