"""Zones around a robot, and tests for points in them, with the shapes and the counting of Nav2's
collision monitor.

A zone is in force while at least `MIN_POINTS` points of the last scan are in it. A scan that is too
old stops the robot.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from heron.messages import Message
from heron.topics import SCAN, Carrier

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
MIN_POINTS = 4
"""The number in the tutorial of Nav2; fewer points are dust."""
SOURCE_TIMEOUT_NS = 1_000_000_000
NO_SCAN = "no_scan"
"""Replaces a zone while the last scan is too old."""


class Shape(Protocol):
    """The area of a zone, in the frame of the scan."""

    def covers(self, x: Floats, y: Floats) -> Flags:
        """A flag for each of these points (m): True inside the shape."""


@dataclass(frozen=True)
class ScannerRectangle:
    """A rectangle from x to x, and as far to both sides of the x axis (m)."""

    low_x: float
    high_x: float
    half_width: float

    def covers(self, x: Floats, y: Floats) -> Flags:
        """A flag for each of these points (m): True inside the shape."""
        found: Flags = (x >= self.low_x) & (x <= self.high_x) & (np.abs(y) <= self.half_width)
        return found


@dataclass(frozen=True)
class ScannerCircle:
    """A circle around the scanner (m)."""

    radius: float

    def covers(self, x: Floats, y: Floats) -> Flags:
        """A flag for each of these points (m): True inside the shape."""
        found: Flags = x * x + y * y <= self.radius * self.radius
        return found


@dataclass(frozen=True)
class SpeedZone:
    """A zone leaves this share of the speed while something is in it; a stop zone leaves none."""

    name: str
    shape: Shape
    ratio: float


class ZoneWatch:
    """Counts the points of each scan in each zone."""

    def __init__(self, carrier: Carrier, zones: Sequence[SpeedZone]) -> None:
        self._zones = zones
        self._counts = dict.fromkeys(zones, 0)
        self._scanned_ns: int | None = None
        self._now_ns = 0
        carrier.subscribe(SCAN, self._look)

    @property
    def has_begun(self) -> bool:
        """True after the first scan."""
        return self._scanned_ns is not None

    def in_force(self, now_ns: int) -> dict[str, float]:
        """The share of the speed that each zone in force leaves, by the names of the zones."""
        self._now_ns = now_ns
        if self._scanned_ns is None or now_ns - self._scanned_ns > SOURCE_TIMEOUT_NS:
            return {NO_SCAN: 0.0}
        return {
            zone.name: zone.ratio for zone, count in self._counts.items() if count >= MIN_POINTS
        }

    def _look(self, scan: Message) -> None:
        """A scan over a full turn. A beam that does not return has no point."""
        angles = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges))
        ranges = scan.ranges.astype(np.float64)
        is_seen = np.isfinite(ranges)
        x, y = ranges[is_seen] * np.cos(angles[is_seen]), ranges[is_seen] * np.sin(angles[is_seen])
        for zone in self._zones:
            self._counts[zone] = int(np.count_nonzero(zone.shape.covers(x, y)))
        self._scanned_ns = self._now_ns
