"""A model of Nav2's collision monitor: its answer to a scan and a command.

The model follows `nav2_collision_monitor` 1.3.13 of Jazzy
(github.com/ros-navigation/navigation2, commit f4108e5b1c2b): `process`,
`processStopSlowdownLimit` and `processApproach` of
`src/collision_monitor_node.cpp`, `getCollisionTime` and `isPointInside` of `src/polygon.cpp`,
`getPointsInside` of `src/circle.cpp`, `getData` of `src/scan.cpp`, `sourceValid` of
`src/source.cpp`, and `src/kinematics.cpp`. The model has one source, a scan in the frame of the
base, and no correction of the shift of the base. `nav2_node.py` runs the real node if the node is
installed; `beside_nav2.py` compares the node with the model.
"""

from __future__ import annotations

import math

import numpy as np
from course import NS, Command, Odometry, Scan
from course_shapes import Floats
from nav2_settings import Settings, Zone
from numpy.typing import NDArray

STILL = Command(0.0, 0.0)


class CollisionMonitor:
    """The monitor with its settings. The monitor has no memory."""

    def __init__(self, settings: Settings) -> None:
        self._timeout_ns = round(settings.source_timeout * NS)
        self._zones = [_Area(zone) for zone in settings.zones]

    def __call__(
        self,
        scan: Scan | None,
        odometry: Odometry,  # noqa: ARG002 - the monitor does not use it
        command: Command,
        at_ns: int,
    ) -> Command:
        """The command after the monitor."""
        if scan is None or not self.is_valid(scan, at_ns):
            return STILL
        points = points_of(scan)
        given = command
        for area in self._zones:
            safe = area.changed(points, command)
            if safe is None:
                continue
            if area.zone.action_type == "stop":
                return STILL
            if _speed(safe) < _speed(given):
                given = safe
        return given

    def is_valid(self, scan: Scan, at_ns: int) -> bool:
        """Say whether a scan is new enough."""
        return at_ns - scan.stamp_ns <= self._timeout_ns


def points_of(scan: Scan) -> Floats:
    """The points of the readings within the limits of the lidar (m). Angles add up in float32."""
    steps = np.full(len(scan.ranges), np.float32(scan.angle_increment))
    steps[0] = np.float32(scan.angle_min)
    angles = np.cumsum(steps, dtype=np.float32)
    low, high = np.float32(scan.range_min), np.float32(scan.range_max)
    is_return = (scan.ranges >= low) & (scan.ranges <= high)
    found, angles = scan.ranges[is_return], angles[is_return]
    return np.column_stack([found * np.cos(angles), found * np.sin(angles)]).astype(np.float64)


class _Area:
    """A zone that counts the points inside."""

    def __init__(self, zone: Zone) -> None:
        self.zone = zone
        self._corners = np.array(zone.points, dtype=np.float32).astype(np.float64)

    def changed(self, points: Floats, command: Command) -> Command | None:
        """The command that the zone requests; None if the zone requests no change."""
        zone = self.zone
        if zone.action_type == "approach":
            at_s = self._collision_s(points, command)
            return None if at_s is None else _times(command, at_s / zone.time_before_collision)
        if not self._has(points):
            return None
        if zone.action_type == "stop":
            return STILL
        if zone.action_type == "slowdown":
            return _times(command, zone.slowdown_ratio)
        return _times(command, self._limiting(command))

    def _limiting(self, command: Command) -> float:
        ratio = 1.0
        if command.linear != 0.0:
            ratio = min(ratio, self.zone.linear_limit / abs(command.linear))
        if command.angular != 0.0:
            ratio = min(ratio, self.zone.angular_limit / abs(command.angular))
        return max(0.0, ratio)

    def _has(self, points: Floats) -> bool:
        """Say whether enough points are in the zone."""
        return int(self._covers(points).sum()) >= self.zone.min_points

    def _covers(self, points: Floats) -> NDArray[np.bool_]:
        x, y = points.T
        if not len(self._corners):
            within: NDArray[np.bool_] = x * x + y * y < self.zone.radius**2
            return within
        is_in = np.zeros(len(points), dtype=bool)
        start = self._corners[-1]
        for end in self._corners:
            is_beside = (y <= start[1]) == (y > end[1])
            if is_beside.any():
                meets = start[0] + (y - start[1]) * (end[0] - start[0]) / (end[1] - start[1])
                is_in ^= is_beside & (meets > x)
            start = end
        return is_in

    def _collision_s(self, points: Floats, command: Command) -> float | None:
        """The time until enough points are in the zone, if the base continues to drive like this,
        in s.
        """
        if self._has(points):
            return 0.0
        zone = self.zone
        step_s = zone.simulation_time_step
        turn = command.angular * step_s
        x = y = heading = time_s = 0.0
        forwards, sidewards = command.linear, 0.0
        while time_s <= zone.time_before_collision:
            x, y, heading = x + forwards * step_s, y + sidewards * step_s, heading + turn
            cosine, sine = math.cos(turn), math.sin(turn)
            forwards, sidewards = (
                forwards * cosine - sidewards * sine,
                forwards * sine + sidewards * cosine,
            )
            cosine, sine = math.cos(heading), math.sin(heading)
            moved = points - np.array([x, y])
            turned = moved @ np.array([[cosine, -sine], [sine, cosine]])
            if self._has(turned):
                return time_s
            time_s += step_s
        return None


def _speed(command: Command) -> float:
    return command.linear**2 + command.angular**2


def _times(command: Command, ratio: float) -> Command:
    return Command(command.linear * ratio, command.angular * ratio)
