"""Messages of sensors that offer rules more fields than their definitions: clouds and scans."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from rossmarie.types.definitions import DefinedField, MessageDefinition
from rossmarie.types.model import Array, Beam, List, Quantity, ScanPoint, Type

CLOUD = "sensor_msgs/PointCloud2"
POINTS = "points"
"""The field for the points of a cloud. Its definition has only bytes instead."""
SCAN = "sensor_msgs/LaserScan"
RETURNS, INVALID = POINTS, "invalid"
"""The names of the points of a scan, and of the beams without a reading."""

LAYOUT_OF_POINTS = {
    "height": DefinedField("uint32", is_array=False),
    "width": DefinedField("uint32", is_array=False),
    "fields": DefinedField("sensor_msgs/PointField", is_array=True),
    "is_bigendian": DefinedField("bool", is_array=False),
    "point_step": DefinedField("uint32", is_array=False),
    "row_step": DefinedField("uint32", is_array=False),
    "data": DefinedField("uint8", is_array=True),
}
LAYOUT_OF_BEAMS = {
    **{
        name: DefinedField("float32", is_array=False)
        for name in ("angle_min", "angle_max", "angle_increment", "range_min", "range_max")
    },
    **{name: DefinedField("float32", is_array=True) for name in ("ranges", "intensities")},
}


def tells(definition: MessageDefinition, layout: Mapping[str, DefinedField]) -> bool:
    """Say whether a cloud or a scan has all fields that determine its points. The search path may
    contain another definition.
    """
    return all(definition.fields.get(name) == each for name, each in layout.items())


def beams_of(fields: Mapping[str, Type]) -> Mapping[str, Type]:
    """The readings of a scan with its angles, and the lists of its beams."""
    ranges, angle, intensities = (fields[name] for name in ("ranges", "angle_min", "intensities"))
    assert isinstance(ranges, Array), "the layout says so"
    assert isinstance(intensities, Array), "the layout says so"
    assert isinstance(angle, Quantity), "the layout says so"
    assert isinstance(ranges.element, Quantity), "the layout says so"
    assert isinstance(intensities.element, Quantity), "the layout says so"
    seen = {"range": ranges.element, "angle": angle, "intensity": intensities.element}
    return {
        "ranges": replace(ranges, has_sectors=True),
        RETURNS: List(ScanPoint(ranges.element, is_position=True, fields=seen)),
        INVALID: List(Beam(f"{SCAN} beam", {"angle": angle})),
    }
