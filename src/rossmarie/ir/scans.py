"""The beams of a `sensor_msgs/LaserScan`: sectors (S71), points (S72), and beams without a reading
(S73).

A scan describes the angles of its beams, and the distances between which it measures. This
description is checked: a scan that contradicts itself is unknown (S70).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Protocol, TypeGuard

import numpy as np
from numpy.typing import NDArray

from rossmarie.core.angles import HALF_TURN, RIGHT_ANGLE
from rossmarie.ir.model import Array, Machine
from rossmarie.ir.path import INVALID, RETURNS, Beams, Sector

TURN = 2.0 * HALF_TURN

SLACK = 0.01
"""The share of an increment by which beams may miss an angle, because scans contain 32-bit
numbers.
"""

_MISCOUNT = 1.5
"""The increments by which `angle_max` may be off: drivers differ by one beam in its definition."""


class LaserScan(Protocol):
    """An object of any class with the fields of the message."""

    angle_min: float
    angle_max: float
    angle_increment: float
    range_min: float
    range_max: float
    ranges: Any
    intensities: Any


class UnreadableScanError(Exception):
    """The reason why a requested value of a scan is unknown."""


@dataclass(frozen=True, eq=False)
class _Measured:
    """The beams of a consistent scan. `step` is the angle between two beams, and `least` the
    smaller of the angles of the first and the last beam.
    """

    ranges: NDArray[np.float64]
    angles: NDArray[np.float64]
    step: float
    least: float
    returns: NDArray[np.bool_]
    is_close: NDArray[np.bool_]
    sees_nothing: NDArray[np.bool_]

    @property
    def tells(self) -> NDArray[np.bool_]:
        """The beams that are not left out."""
        return self.returns | self.is_close | self.sees_nothing


def is_scan(value: object) -> TypeGuard[LaserScan]:
    """Say whether a value looks like the message of a scan."""
    return hasattr(value, "angle_increment") and hasattr(value, "ranges")


def taken(scan: LaserScan, array: Array, most: int) -> NDArray[np.float64]:
    """The numbers of an array that is computed from a scan; `most` is the bound of its list, if it
    has one.

    Raises `UnreadableScanError`.
    """
    for step in array.path:
        if isinstance(step, Sector):
            return sector(scan, step)
        if isinstance(step, Beams):
            return beams(scan, step, str(array.path[-1]), most)
    raise AssertionError(f"{array.path} is of no scan")


def all_taken(machine: Machine, scan: LaserScan, arrays: Sequence[int]) -> dict[int, list[float]]:
    """The numbers of these arrays of a machine, computed from this scan. Unknown arrays are left
    out.
    """
    found: dict[int, list[float]] = {}
    for index in arrays:
        array = machine.arrays[index]
        most = 0 if array.list is None else machine.lists[array.list].most
        with suppress(UnreadableScanError):
            found[index] = list(map(float, taken(scan, array, most)))
    return found


def sector(scan: LaserScan, wanted: Sector) -> NDArray[np.float64]:
    """The valid readings of a sector, with +inf for nothing in range.

    Raises `UnreadableScanError` if there are none, or if the beams do not cover the whole sector.
    """
    measured = _measured(scan)
    if not _reaches_over(measured, wanted):
        raise UnreadableScanError(f"it does not cover {wanted}")
    is_inside = _inside(measured.angles, measured.step, wanted) & measured.tells
    found = np.where(measured.sees_nothing, math.inf, measured.ranges)[is_inside]
    if not len(found):
        raise UnreadableScanError(f"no beam has a valid reading in {wanted}")
    return found


def beams_inside(scan: LaserScan, wanted: Sector) -> NDArray[np.bool_]:
    """The beams of a scan that are in a sector, whatever their readings."""
    angles = _angles(float(scan.angle_min), float(scan.angle_increment), len(scan.ranges))
    return _inside(angles, abs(float(scan.angle_increment)), wanted)


def beams(scan: LaserScan, kind: Beams, field: str, most: int) -> NDArray[np.float64]:
    """One field of the points of a scan, or of the beams without a reading.

    Raises `UnreadableScanError`, also if the scan has more than `most` beams.
    """
    measured = _measured(scan)
    if len(measured.ranges) > most:
        raise UnreadableScanError(f"it has more than {most} beams")
    which = measured.returns | measured.is_close if kind == RETURNS else ~measured.tells
    if field == "angle":
        angles = measured.angles[which]
        turned: NDArray[np.float64] = angles - np.floor((angles + HALF_TURN) / TURN) * TURN
        return turned
    assert kind != INVALID, "all that is known of these is where they point"
    if field == "range":
        return np.where(measured.is_close, math.nan, measured.ranges)[which]
    intensities = np.asarray(scan.intensities, np.float64)
    if len(intensities) != len(measured.ranges):
        count = len(measured.ranges)
        raise UnreadableScanError(f"it has {len(intensities)} intensities for {count} beams")
    return intensities[which]


def _measured(scan: LaserScan) -> _Measured:
    ranges = np.asarray(scan.ranges, np.float64)
    first, last, step = (
        float(each) for each in (scan.angle_min, scan.angle_max, scan.angle_increment)
    )
    low, high = float(scan.range_min), float(scan.range_max)
    count, size = len(ranges), abs(step)
    if not count:
        raise UnreadableScanError("it has no beams")
    if not all(map(math.isfinite, (first, last, step))):
        raise UnreadableScanError("its angles are not numbers")
    if count > 1 and not 0.0 < size <= RIGHT_ANGLE:
        raise UnreadableScanError(f"its `angle_increment` is {step:g}")
    if abs((last - first) - step * (count - 1)) > _MISCOUNT * size:
        raise UnreadableScanError(f"it has {count} beams, which do not fit its angles")
    if not (0.0 <= low <= high and high > 0.0 and low < math.inf):
        raise UnreadableScanError(f"it measures from {low:g} m to {high:g} m")
    sees_nothing = (ranges > high) | (ranges == math.inf)
    return _Measured(
        ranges,
        _angles(first, step, count),
        size,
        min(first, first + (count - 1) * step),
        (ranges >= low) & (ranges <= high) & ~sees_nothing,
        ranges == -math.inf,
        sees_nothing,
    )


def _angles(first: float, step: float, count: int) -> NDArray[np.float64]:
    return first + np.arange(count, dtype=np.float64) * step


def _inside(angles: NDArray[np.float64], step: float, wanted: Sector) -> NDArray[np.bool_]:
    slack = SLACK * step
    ahead = angles - wanted.first
    ahead = ahead - np.floor(ahead / TURN) * TURN
    return (ahead <= wanted.width + slack) | (ahead >= TURN - slack)


def _reaches_over(measured: _Measured, wanted: Sector) -> bool:
    """Say whether the beams cover a sector, up to one increment at each end."""
    span = measured.step * (len(measured.ranges) - 1)
    step = (1.0 + SLACK) * measured.step
    if span + step >= TURN:
        return True
    ahead = (wanted.first - measured.least) + step
    ahead = ahead - math.floor(ahead / TURN) * TURN
    return (ahead - step) + wanted.width <= span + step
