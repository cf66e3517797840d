"""The refusal of a machine that breaks its own rules: the first defect, where it is and what."""

from __future__ import annotations

import math
from collections.abc import Iterable

from rossmarie.ir.limits import LONGEST_NS


class MalformedMachine(Exception):
    """A machine breaks its own rules: a fault of the compiler, never of the user's file."""


def require(is_so: bool, where: str, what: str) -> None:
    """Raise `MalformedMachine` unless it is so."""
    if not is_so:
        raise MalformedMachine(f"{where}: {what}")


def require_index(index: int, total: int, where: str, what: str) -> None:
    """An index of one of `total` things."""
    require(0 <= index < total, where, f"there is no {what} {index}")


def require_duration(duration_ns: int, where: str) -> None:
    """A duration of at least a nanosecond, below `LONGEST_NS`."""
    require(0 < duration_ns < LONGEST_NS, where, f"a duration of {duration_ns} ns")


def require_finite(values: Iterable[float], where: str) -> None:
    """Numbers that are neither infinite nor NaN."""
    for value in values:
        require(math.isfinite(value), where, f"{value} is not finite")
