"""Limits of instants, so that targets can compute with 64-bit integers, and a limit of the time of
one call.

An instant plus a duration, and the difference of two instants, never leave the range of int64.
"""

from __future__ import annotations

from operator import index
from typing import SupportsIndex

EARLIEST_NS = -(2**61)
"""The lower limit of instants (in the year 1896, counted from the Unix epoch)."""

LATEST_NS = 2**62
"""The upper limit of instants (in the year 2116, counted from the Unix epoch)."""

LONGEST_NS = 2**61
"""The upper limit of durations (73 years)."""

NEVER_NS = 2**63 - 1
"""A value after every instant; in C, it stands for an event that has not happened."""

MOST_POSES = 10_000
"""The most poses that a memory can hold."""

MOST_POSES_IN_ALL = 100_000
"""The most poses that all effects of a program can ask for."""

MOST_EVALUATIONS = 10_000
"""The most evaluations in one call of a monitor, however long the time since the last call."""


def as_instant(at_ns: SupportsIndex) -> int:
    """An instant as an integer. Raises `TypeError` if the instant is not an integer."""
    try:
        return index(at_ns)
    except TypeError:
        raise TypeError(
            "an instant is an integer number of nanoseconds, such as 500_000_000 for 0.5 s, "
            f"not {at_ns!r}"
        ) from None


def require_instant(at_ns: int) -> None:
    """Raise `ValueError` for an instant out of range."""
    if not EARLIEST_NS < at_ns < LATEST_NS:
        raise ValueError(f"an instant of {at_ns} ns is out of range")
