"""The types of expressions.

`Unknown` absorbs errors: an expression of this type, or an operand of it, has been reported. No
operation on it is reported again.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rossmarie.units import Unit

AXES = ("x", "y", "z")
"""The components of a vector."""


@dataclass(frozen=True)
class Boolean:
    """True, false or unknown."""


@dataclass(frozen=True)
class Text:
    """A string, for comparison with strings."""


@dataclass(frozen=True)
class Quantity:
    """A number. `unit` is the unit in which it is written or arrives; two quantities are comparable
    if their units have the same dimension. None is for a message field without a known unit.
    `limits` are the least and the greatest number that a field of whole numbers can hold.
    """

    unit: Unit | None
    limits: tuple[float, float] | None = field(default=None, compare=False)


@dataclass(frozen=True)
class Vector:
    """Three numbers x, y, z with one unit (geometry_msgs Vector3, Point, Point32). A position is a
    point in its frame; any other vector is only a direction and a length.
    """

    element: Quantity
    is_position: bool = field(default=False, compare=False)


@dataclass(frozen=True)
class Point(Vector):
    """A point of a sensor_msgs/PointCloud2: its position x, y, z, and fields with any other names.
    Only a cloud determines its fields; `fields` contains the fields with a declared unit.
    """

    fields: Mapping[str, Quantity] = field(default_factory=dict, compare=False)

    def member(self, name: str) -> Quantity:
        """The type of a field."""
        return self.element if name in AXES else self.fields.get(name, Quantity(None))


@dataclass(frozen=True)
class ScanPoint(Vector):
    """A point of a sensor_msgs/LaserScan: its position x, y, z, and the other `fields`."""

    fields: Mapping[str, Quantity] = field(default_factory=dict, compare=False)


@dataclass(frozen=True)
class Quaternion:
    """An orientation x, y, z, w (geometry_msgs Quaternion)."""


@dataclass(frozen=True)
class Array:
    """Any number of elements (`float32[] ranges`); `element` is a Quantity or Boolean. `names` is
    the field with the names of the elements, or the names that an input declares. `has_sectors` is
    true if the elements are readings of a scan, which gives the angle of each.
    """

    element: Quantity | Boolean
    names: str | tuple[str, ...] | None = field(default=None, compare=False)
    has_sectors: bool = field(default=False, compare=False)


@dataclass(frozen=True)
class List:
    """Any number of messages (`Detection3D[] detections`), which rules use one by one."""

    element: Message | Vector | Quaternion

    @property
    def is_of_points(self) -> bool:
        """Say whether the elements are points of a cloud, which are no messages of their own."""
        return isinstance(self.element, Point)

    @property
    def is_of_beams(self) -> bool:
        """Say whether the elements are beams of a scan, which are no messages of their own."""
        return isinstance(self.element, ScanPoint | Beam)


@dataclass(frozen=True)
class Interval:
    """`[low, high]`, both ends included."""

    element: Quantity


@dataclass(frozen=True)
class Box:
    """`[xmin, xmax, ymin, ymax, zmin, zmax]`."""

    element: Quantity


@dataclass(frozen=True)
class Region:
    """A zone, or all locations of a class of objects, in the x-y plane of a frame. `has_area` is
    true if it contains shapes besides points.
    """

    name: str
    frame: str
    has_area: bool
    is_zone: bool = False


@dataclass(frozen=True)
class Motion:
    """A motion of the robot, by its name: its position, its speed, and its deceleration."""

    name: str


@dataclass(frozen=True)
class Message:
    """A ROS message, `sensor_msgs/Imu`, with the types of its fields, without constants. `names` is
    the field with the names of the elements of its arrays, if it has one.
    """

    name: str
    fields: Mapping[str, Type]
    names: str | None = None

    def __hash__(self) -> int:
        return hash(self.name)


@dataclass(frozen=True)
class Beam(Message):
    """A beam of a sensor_msgs/LaserScan without a reading."""

    __hash__ = Message.__hash__


@dataclass(frozen=True)
class Entry:
    """All values that a message with names holds under one of the names: `joints["elbow"]`."""

    message: Message


@dataclass(frozen=True)
class Unsupported:
    """A message field that rules cannot use (for example an array of messages), with the reason."""

    reason: str


@dataclass(frozen=True)
class Unknown:
    """The type of an expression that has already been reported."""


Type = (
    Boolean
    | Text
    | Quantity
    | Vector
    | Quaternion
    | Array
    | List
    | Interval
    | Box
    | Region
    | Motion
    | Message
    | Entry
    | Unsupported
    | Unknown
)
