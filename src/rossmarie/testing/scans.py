"""Laser scans in tests that set only the readings of sectors (S70 to S73).

By default, a scan covers the full circle with one beam per degree, and no beam hits anything.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from types import SimpleNamespace

import numpy as np

from rossmarie.ir import Array, Machine, Path, Sector
from rossmarie.ir.beams import USUAL_DISTANCES, is_of_scan, scan_path
from rossmarie.ir.carried import raw_of
from rossmarie.ir.scans import UnreadableScanError, beams_inside, taken
from rossmarie.ir.script import SettingValue

BEAMS = 360
USUAL: Mapping[str, SettingValue] = {
    "angle_min": math.radians(-180),
    "angle_max": math.radians(179),
    "angle_increment": math.radians(1),
    "range_min": USUAL_DISTANCES[0],
    "range_max": USUAL_DISTANCES[1],
    "ranges": (math.inf,) * BEAMS,
}
"""The default values of the fields of a scan, in SI."""

FIELDS = frozenset((*USUAL, "intensities"))
"""The fields on which sectors and beams depend."""

Place = tuple[str, Path]
"""A topic, and a path in its messages."""

Values = Mapping[Place, SettingValue]


def usual_scans(machine: Machine) -> Iterator[tuple[Place, SettingValue]]:
    """The default fields of all scans whose sectors or beams are read."""
    for topic, path in sorted(_scans(machine), key=str):
        for name, value in USUAL.items():
            yield (topic, (*path, name)), value


def set_sector(
    values: Values, topic: str, path: Path, value: SettingValue
) -> tuple[Place, SettingValue]:
    """The readings of a scan in which those of one sector are set. `path` ends with the sector. One
    value sets all readings of the sector; None or () sets them to NaN; a tuple sets them one by
    one, and the readings after its last value hit nothing.
    """
    *before, _, sector = path
    assert isinstance(sector, Sector), "only sectors are set so"
    place = (topic, (*before, "ranges"))
    scan = _scan(values, topic, tuple(before))
    readings = list(scan.ranges)
    inside = np.flatnonzero(beams_inside(scan, sector)).tolist()
    if isinstance(value, tuple) and len(value) < 2:
        value = value[0] if value else None
    wanted: Sequence[object] = value if isinstance(value, tuple) else [value] * len(inside)
    for beam, reading in zip(inside, [*wanted, *[math.inf] * len(inside)], strict=False):
        readings[beam] = _number(reading)
    return place, tuple(readings)


def arrays_of_scans(
    machine: Machine, values: Values, of_channel: Callable[[int], bool]
) -> dict[int, list[float]]:
    """The sectors and the beams of the scans of a channel, in the form that messages carry. Unknown
    ones are left out.
    """
    found: dict[int, list[float]] = {}
    for index, array in enumerate(machine.arrays):
        if not is_of_scan(array) or not of_channel(array.input):
            continue
        most = 0 if array.list is None else machine.lists[array.list].most
        topic = machine.channels[machine.inputs[array.input].channel].topic
        numbers = _taken(values, topic, array, most)
        if numbers is not None:
            found[index] = [raw_of(array, each) for each in numbers]
    return found


def _taken(values: Values, topic: str, array: Array, most: int) -> list[float] | None:
    path = scan_path(array.path)
    assert path is not None, "it is of a scan"
    try:
        return list(map(float, taken(_scan(values, topic, path), array, most)))
    except UnreadableScanError:
        return None


def _scan(values: Values, topic: str, path: Path) -> SimpleNamespace:
    """The scan as it was set, in SI."""
    fields = {name: values.get((topic, (*path, name)), usual) for name, usual in USUAL.items()}
    numbers = {name: _number(fields[name]) for name in USUAL if name != "ranges"}
    ranges, intensities = fields["ranges"], values.get((topic, (*path, "intensities")))
    readings = [_number(each) for each in ranges] if isinstance(ranges, tuple) else []
    brightness = [0.0] * len(readings) if intensities is None else intensities
    return SimpleNamespace(**numbers, ranges=readings, intensities=brightness)


def _scans(machine: Machine) -> set[Place]:
    found: set[Place] = set()
    for array in machine.arrays:
        path = scan_path(array.path)
        if path is not None:
            found.add((machine.channels[machine.inputs[array.input].channel].topic, path))
    return found


def _number(value: object) -> float:
    return float(value) if isinstance(value, float | bool) else math.nan
