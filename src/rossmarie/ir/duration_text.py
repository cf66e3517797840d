"""Durations in readable form."""

from __future__ import annotations


def duration_text(duration_ns: int) -> str:
    """A duration in seconds without loss, `0.25 s`."""
    seconds, rest = divmod(duration_ns, 1_000_000_000)
    fraction = f".{rest:09d}".rstrip("0") if rest else ""
    return f"{seconds}{fraction} s"
