"""The growth of work with its size, measured independently of the load of the machine."""

from __future__ import annotations

import cProfile
import gc
import time
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")

NOTHING_S = 0.2
"""Seconds of CPU that are nothing, whatever the size."""

ATTEMPTS = 3
"""Other processes slow one of two measurements, but hardly three times the same."""


def calls_of(work: Callable[[T], object], thing: T) -> int:
    """The number of called functions, which does not depend on the machine or its load."""
    with cProfile.Profile() as profile:
        work(thing)
    return sum(entry.callcount for entry in profile.getstats())


def cpu_s_of(work: Callable[[T], object], thing: T) -> float:
    """Seconds of CPU, which also count the work of what is written in C.

    Nobody looks for garbage meanwhile: that takes as long as all tests before have left objects.
    """
    was_enabled = gc.isenabled()
    gc.disable()
    begin = time.process_time()
    try:
        work(thing)
        return time.process_time() - begin
    finally:
        if was_enabled:
            gc.enable()


def takes_at_most(times: float, work: Callable[[T], object], small: T, large: T) -> bool:
    """Say whether the work on a large thing takes at most `times` the processor time of the work on
    a small one.
    """
    return any(
        cpu_s_of(work, large) < NOTHING_S + times * cpu_s_of(work, small) for _ in range(ATTEMPTS)
    )
