"""The error for a malformed machine: the first defect, with its place."""

from __future__ import annotations

import math
from collections.abc import Iterable

from rossmarie.ir.limits import LONGEST_NS


class MalformedMachine(Exception):
    """A machine violates the rules of the model: a defect of the compiler, never of the user's
    file.
    """


def require(is_so: bool, where: str, what: str) -> None:
    """Raise `MalformedMachine` unless the condition is true."""
    if not is_so:
        raise MalformedMachine(f"{where}: {what}")


def require_index(index: int, total: int, where: str, what: str) -> None:
    """Require an index of one of `total` elements."""
    require(0 <= index < total, where, f"there is no {what} {index}")


def require_duration(duration_ns: int, where: str) -> None:
    """Require a duration of at least a nanosecond, below `LONGEST_NS`."""
    require(0 < duration_ns < LONGEST_NS, where, f"a duration of {duration_ns} ns")


def require_finite(values: Iterable[float], where: str) -> None:
    """Require numbers that are neither infinite nor NaN."""
    for value in values:
        require(math.isfinite(value), where, f"{value} is not finite")
