"""Laser scans: of random angles, with what they say in whole degrees; and scans that lie."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from random import Random
from types import SimpleNamespace
from typing import Any

import numpy as np
from rosbags.typesys.store import Typestore

from support.recordings import stamped

LOW, HIGH = 0.125, 12.0
"""The distances between which scans measure; both are numbers of 32 bits."""

READINGS = (math.nan, math.inf, -math.inf, 0.0, -1.0, 0.0625, LOW, 1.5, 3.25, HIGH, 40.0)


@dataclass(frozen=True)
class Made:
    """A scan, and at how many degrees its first beam is, and between two of them."""

    scan: SimpleNamespace
    first: int
    step: int

    def expected(self, low: int, high: int) -> list[float] | None:
        """The readings that S71 gives, from half a degree behind `low` to half a degree behind
        `high`, by whole degrees.
        """
        count, width = len(self.scan.ranges), high - low
        turned = [(self.first + self.step * beam - low) % 360 for beam in range(count)]
        size = abs(self.step)
        is_whole = count * size >= 360
        least = self.first + min(0, self.step * (count - 1))
        ahead = (
            low - (least - size)
        ) % 360  # from where the scan reaches to, by one increment more
        if not is_whole and ahead + width + 1 > (count + 1) * size:
            return None
        found = [
            readable(reading)
            for beam, reading in zip(turned, self.scan.ranges, strict=True)
            if 0 < (beam or 360) <= width and reported(reading)
        ]
        return found or None


def reported(reading: float) -> bool:
    """Say whether a reading tells something."""
    return math.isinf(reading) or reading >= LOW


def readable(reading: float) -> float:
    return math.inf if reading > HIGH else reading


def random_scan(random: Random) -> Made:
    """A scan in whole degrees, forwards or backwards, of a turn or less."""
    step = random.choice([-1, 1]) * random.choice([1, 2, 3, 5, 10])
    most = 360 // abs(step)
    count = random.choice([most, most, most + 1, random.randrange(1, most + 1)])
    first = random.choice([-180, 0, -135, random.randrange(-360, 360)])
    ranges = [random.choice(READINGS) for _ in range(count)]
    return Made(plain_scan(ranges, first, step), first, step)


def plain_scan(ranges: Sequence[float], first: float = -180, step: float = 1) -> SimpleNamespace:
    """A scan whose first beam is at `first` degrees; all numbers are of 32 bits."""
    last = first + step * (len(ranges) - 1)
    return SimpleNamespace(
        angle_min=single(math.radians(first)),
        angle_max=single(math.radians(last)),
        angle_increment=single(math.radians(step)),
        time_increment=0.0,
        scan_time=0.1,
        range_min=single(LOW),
        range_max=single(HIGH),
        ranges=[single(each) for each in ranges],
        intensities=[float(10 * beam) for beam in range(len(ranges))],
    )


def single(number: float) -> float:
    """The number of 32 bits that is nearest."""
    return float(np.float32(number))


def message(ros: Typestore, index: int, scan: SimpleNamespace) -> Any:
    """The scan as a message of rosbags."""
    fields = {**vars(scan)}
    for name in ("ranges", "intensities"):
        fields[name] = np.array(fields[name], np.float32)
    return ros.types["sensor_msgs/msg/LaserScan"](header=stamped(ros, index), **fields)


# --- scans that lie --------------------------------------------------------------------------


def _set(**changes: Any) -> Callable[[SimpleNamespace], None]:
    return lambda scan: vars(scan).update(changes)


LIES: Mapping[str, Callable[[SimpleNamespace], None]] = {
    "no beams": _set(ranges=[], intensities=[]),
    "no first angle": _set(angle_min=math.nan),
    "an infinite first angle": _set(angle_min=-math.inf),
    "no last angle": _set(angle_max=math.nan),
    "an infinite last angle": _set(angle_max=math.inf),
    "no increment": _set(angle_increment=0.0),
    "an unknown increment": _set(angle_increment=math.nan),
    "an increment of half a turn": _set(angle_increment=3.0),
    "an increment backwards": lambda scan: vars(scan).update(angle_increment=-scan.angle_increment),
    "half of the increment": lambda scan: vars(scan).update(
        angle_increment=scan.angle_increment / 2
    ),
    "too few beams": lambda scan: vars(scan).update(ranges=scan.ranges[:-2]),
    "too many beams": lambda scan: vars(scan).update(ranges=[*scan.ranges, 1.0, 1.0]),
    "no least distance": _set(range_min=math.nan),
    "a least distance below 0": _set(range_min=-0.5),
    "an infinite least distance": _set(range_min=math.inf, range_max=math.inf),
    "no greatest distance": _set(range_max=math.nan),
    "limits that are exchanged": _set(range_min=HIGH, range_max=LOW),
    "no limits at all": _set(range_min=0.0, range_max=0.0),
}
"""Changes to `truthful()` after each of which nothing is known of it."""


def truthful() -> SimpleNamespace:
    """A full turn, of which one beam returns."""
    return plain_scan([1.5, *[math.inf] * 359])
