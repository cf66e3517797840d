"""Trajectories whose time can be scaled: the path stays the same and is followed more slowly."""

from __future__ import annotations

import math

import numpy as np

from heron.robot.physics import Floats

_PEAK_SPEED = 1.875  # of the profile, for a distance and a duration of one
_PEAK_ACCELERATION = 5.774
_LEAST_DURATION = 0.1  # s


class Trajectory:
    """A straight path that begins and ends at rest, with the least jerk for its duration (s)."""

    def __init__(self, start: Floats, end: Floats, duration: float) -> None:
        self._start, self.end = start.copy(), end.copy()
        self._duration = duration
        self._passed = 0.0

    def advance(self, step_s: float) -> Floats:
        """Advance the trajectory's own time and return the position."""
        self._passed = min(self._duration, self._passed + step_s)
        share = self._passed / self._duration
        smooth = share**3 * (10 - 15 * share + 6 * share**2)
        found: Floats = self._start + smooth * (self.end - self._start)
        return found

    @property
    def is_over(self) -> bool:
        """True once its end is reached."""
        return self._passed >= self._duration


def duration_of(start: Floats, end: Floats, speed: float, acceleration: float) -> float:
    """The shortest one (s) that keeps to a speed (m/s) and an acceleration (m/s^2)."""
    distance = float(np.linalg.norm(end - start))
    by_speed = _PEAK_SPEED * distance / speed
    by_acceleration = math.sqrt(_PEAK_ACCELERATION * distance / acceleration)
    return max(by_speed, by_acceleration, _LEAST_DURATION)
