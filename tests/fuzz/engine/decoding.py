"""Calls of the engine, made of any bytes: instants at and around deadlines, numbers at and around
limits, and now and then any others.
"""

from __future__ import annotations

import math
import struct
import sys
from collections.abc import Sequence
from typing import TypeVar

_T = TypeVar("_T")
_NOTABLE = [
    0.0, -0.0, 0.5, -1.0, 1.0, 2.0, 3.0, -5.0, math.nan, math.inf, -math.inf, 5e-324, -5e-324,
    math.nextafter(0.5, 1.0), math.nextafter(0.5, 0.0), math.nextafter(-1.0, 0.0), 1e-300, -1e300,
    1e300, math.nextafter(2.0, 3.0),
    math.nextafter(1.0, 2.0), sys.float_info.max, -sys.float_info.max,
]  # fmt: skip
_SPANS = [100, 200, 250, 300, 400, 500, 600, 700, 800, 900, 1200]
_STEPS = [0, 0, 0, 1, 7, 50, *(step + near for step in _SPANS for near in (-1, 0, 1))]
_BACK = [-1, -100, -1000, -(2**61)]
_FAR = [2**61 - 2, 2**61 - 1, 2**61, 10**9, 10**15]
_ENDS = [-(2**63), -(2**61), -(2**61) + 1, -1, 0, 2**62 - 1, 2**62, 2**63 - 1]


class Bytes:
    """Bytes that are read from the start to the end; behind the end there are zeros."""

    def __init__(self, content: bytes) -> None:
        self._content = content
        self._place = 0

    @property
    def is_over(self) -> bool:
        """Say whether all were read."""
        return self._place >= len(self._content)

    def byte(self) -> int:
        """The next byte."""
        return self.several(1)[0]

    def several(self, count: int) -> bytes:
        """The next bytes."""
        found = self._content[self._place : self._place + count]
        self._place += count
        return found.ljust(count, b"\0")

    def number(self) -> float:
        """A number as sensors send them, a notable one, or any."""
        chosen = self.byte()
        if chosen < 8:
            return float(struct.unpack("<d", self.several(8))[0])
        if chosen < 128:
            return _chosen(_NOTABLE, chosen)
        return (chosen - 192) / 16

    def instant(self, now_ns: int) -> int:
        """An instant a little ahead, far ahead, back, or any."""
        chosen = self.byte()
        if chosen < 232:
            found = now_ns + _chosen(_STEPS, chosen)
        elif chosen < 240:
            found = now_ns + _chosen(_BACK, chosen)
        elif chosen < 246:
            found = now_ns + _chosen(_FAR, chosen)
        elif chosen < 252:
            found = _chosen(_ENDS, self.byte())
        else:
            found = int.from_bytes(self.several(8), "little", signed=True)
        return max(-(2**63), min(found, 2**63 - 1))


def _chosen(among: Sequence[_T], by: int) -> _T:
    return among[by % len(among)]
