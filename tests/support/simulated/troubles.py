"""Troubles that all bases have: scanners that do not see, and a fall over an edge."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from support.simulated.base import Now, curve, imu
from support.simulated.recording import during
from support.simulated.world import Lidar, Obstacle

Stretch = tuple[float, float]
_TUMBLING_S = 0.8
_FALLEN_DEG = 85.0


@dataclass(frozen=True)
class Scanner:
    """A lidar, and when it sees nothing at all, a cloth lies over it, dust is in the air, or its
    driver has other angles (all in s). The cloth is at a distance (m).
    """

    lidar: Lidar
    period: float  # s
    blind: Stretch
    covered: Stretch
    dusty: Stretch
    narrow: Stretch
    narrowed: tuple[float, float]  # the angles (rad) that are left
    cloth: float

    def fields(
        self, t: float, place: tuple[float, float, float], obstacles: Sequence[Obstacle]
    ) -> dict[str, Any]:
        """The fields of its sensor_msgs/LaserScan at an instant, from a place (m, m, rad)."""
        lidar = self.lidar
        if during(t, self.narrow):
            begin, end = self.narrowed
            within = (lidar.angles >= begin) & (lidar.angles <= end)
            lidar = replace(lidar, angles=lidar.angles[within])
        ranges = lidar.scan(place, obstacles)
        if during(t, self.blind):
            ranges[:] = np.inf
        if during(t, self.covered):
            ranges = np.minimum(ranges, self.cloth)
        if during(t, self.dusty):
            ranges[::3] = 0.0  # less than it can measure: such a beam tells nothing
        return lidar.fields(ranges, self.period)


@dataclass(frozen=True)
class Tipping:
    """A base that tips over an edge to its left, from an instant (s) on, and falls."""

    begin: float

    def imu(
        self, t: float, now: Now, roll: float, pitch: float, jolt: float = 0.0
    ) -> dict[str, Any]:
        """The fields of its sensor_msgs/Imu: angles in rad, the jolt upwards in m/s^2."""
        end = self.begin + _TUMBLING_S
        tipped = math.radians(curve(t, (self.begin, 0.0), (end, _FALLEN_DEG)))
        is_tipping = during(t, (self.begin, end))
        tumbling = math.radians(_FALLEN_DEG) / _TUMBLING_S if is_tipping else 0.0
        felt = imu(now, roll + tipped, pitch, jolt, tumbling)
        if during(t, (self.begin + 0.4, self.begin + 0.6)):
            felt |= {f"linear_acceleration__{axis}": 0.125 for axis in "xyz"}
        return felt
