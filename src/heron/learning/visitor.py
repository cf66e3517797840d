"""The person who comes to the cell in an episode, stands next to it, and leaves."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

Point = tuple[float, float]
_ENTRANCE: Point = (1.2, -1.6)
_BESIDE: Point = (0.25, -0.35)
_RADIUS = 0.22
"""The half width of a person (m)."""


@dataclass(frozen=True)
class Visit:
    """The arrival time (s), walking speed (m/s) and length of stay (s) of a visitor."""

    begin_s: float
    pace: float
    stay_s: float

    def at(self, now_s: float) -> tuple[Point, float, float]:
        """The visitor's position, heading (rad), and walked part of the path in this direction,
        from 0 to 1.
        """
        length = math.dist(_ENTRANCE, _BESIDE)
        walked = max(0.0, now_s - self.begin_s) * self.pace
        gone = walked - length - self.stay_s * self.pace
        if gone <= 0.0:
            return _on(_ENTRANCE, _BESIDE, min(walked, length) / length)
        return _on(_BESIDE, _ENTRANCE, min(gone, length) / length)

    def distance(self, now_s: float, place: Point) -> float:
        """The distance from the visitor's body to a place, along the ground (m)."""
        there, _, _ = self.at(now_s)
        return max(0.0, math.dist(there, place) - _RADIUS)


def visit(chance: np.random.Generator, longest_s: float) -> Visit:
    """A person who comes at some time of an episode. In every third episode, no person comes."""
    begin_s = float(chance.uniform(0.0, 1.5 * longest_s))
    return Visit(begin_s, float(chance.uniform(0.8, 1.4)), float(chance.uniform(1.0, 4.0)))


def _on(start: Point, end: Point, share: float) -> tuple[Point, float, float]:
    (x, y), (there_x, there_y) = start, end
    facing = math.atan2(there_y - y, there_x - x)
    return (x + share * (there_x - x), y + share * (there_y - y)), facing, share
