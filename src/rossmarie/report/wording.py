"""Times in the format of all reports."""

from __future__ import annotations

_MINUTE = 600
_HOUR = 36_000
_DAY = 864_000
"""Longer units, in tenths of a second."""

_ALMOST_A_SECOND_NS = 995_000_000
"""The length in ns from which rounding to two digits gives 1."""


def format_position(position_ns: int) -> str:
    """A position on the axis: `mm:ss.s`, or `h:mm:ss.s` from one hour on."""
    tenths = _tenths(position_ns)
    hours, rest = divmod(tenths, _HOUR)
    minutes, tenths = divmod(rest, _MINUTE)
    text = f"{minutes:02}:{tenths // 10:02}.{tenths % 10}"
    return f"{hours}:{text}" if hours else text


def format_length(length_ns: int) -> str:
    """A length of time: `0.04 s`, `12.4 s`, `3 min 05 s`, `2 h 10 min`, `3 d 4 h`."""
    if length_ns == 0:
        return "0 s"
    if length_ns < _ALMOST_A_SECOND_NS:
        return f"{max(length_ns / 1e9, 0.001):.2g} s"
    tenths = _tenths(length_ns)
    if tenths < _MINUTE:
        return f"{tenths // 10}.{tenths % 10} s"
    if tenths < _HOUR:
        return f"{tenths // _MINUTE} min {tenths % _MINUTE // 10:02} s"
    if tenths < _DAY:
        return f"{tenths // _HOUR} h {tenths % _HOUR // _MINUTE:02} min"
    return f"{tenths // _DAY} d {tenths % _DAY // _HOUR} h"


def _tenths(time_ns: int) -> int:
    return (time_ns + 50_000_000) // 100_000_000
