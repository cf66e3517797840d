"""Durations of checked programs."""

from __future__ import annotations

from rossmarie.check.model import Value


def duration_ns(value: Value) -> int:
    """A constant duration in whole nanoseconds. Its value is in seconds."""
    return round(value.numbers[0] * 1e9)
