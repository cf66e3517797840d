"""Types in the user's words."""

from __future__ import annotations

from rossmarie.types import (
    Array,
    Beam,
    Boolean,
    Box,
    Entry,
    Interval,
    List,
    Message,
    Motion,
    Point,
    Quantity,
    Quaternion,
    Region,
    ScanPoint,
    Text,
    Type,
    Unknown,
    Unsupported,
    Vector,
)
from rossmarie.units import DIMENSIONLESS

_WORDS: dict[type[Type], str] = {
    Boolean: "true or false",
    Text: "a string",
    Quaternion: "an orientation",
    Interval: "an interval",
    Box: "a box",
    Unsupported: "a field that rules cannot use",
    Unknown: "not known",
}


def describe(type_: Type) -> str:
    """`a vector in m/s`; `a text`."""
    match type_:
        case Quantity():
            return _quantity(type_)
        case Vector(element=element):
            return f"{_vector(type_)}{_in_unit(element)}"
        case Array(element=element):
            return _array(element)
        case List(element=element):
            return f"a list of {_plural(element)}"
        case Beam():
            return "a beam of a scan"
        case Message(name=name):
            return f"a message {name}"
        case Entry(message=message):
            return f"the fields of one named element of {message.name}"
        case Motion(name=name):
            return f"the motion {name}"
        case Region(name=name, is_zone=True):
            return f"the zone {name}"
        case Region(name=name, has_area=has_area):
            return f"the {'places' if has_area else 'points'} of {name}"
        case (
            Boolean() | Text() | Quaternion() | Interval() | Box() | Unsupported() | Unknown()
        ):  # fmt: skip
            return _WORDS[type(type_)]


def describe_quantity(quantity: Quantity) -> str:
    """`m/s`, `a plain number`."""
    if quantity.unit is None:
        return "an unknown unit"
    return "a plain number" if is_plain(quantity) else quantity.unit.symbol


def is_plain(quantity: Quantity) -> bool:
    """Say whether the number has the unit 1, or %."""
    return quantity.unit is not None and quantity.unit.dimension == DIMENSIONLESS.dimension


def _quantity(quantity: Quantity) -> str:
    if quantity.unit is None:
        return "a number of unknown unit"
    return "a plain number" if is_plain(quantity) else f"a number in {quantity.unit.symbol}"


def _vector(type_: Vector) -> str:
    match type_:
        case Point():
            return "a point of a cloud"
        case ScanPoint():
            return "a point of a scan"
        case _:  # open: any other vector
            return "a vector"


def _plural(element: Message | Vector | Quaternion) -> str:
    match element:
        case Beam():
            return "beams of a scan"
        case Message(name=name):
            return f"{name} messages"
        case Point(element=part):
            return f"points of a cloud{_in_unit(part)}"
        case ScanPoint(element=part):
            return f"points of a scan{_in_unit(part)}"
        case Vector(element=part):
            return f"vectors{_in_unit(part)}"
        case Quaternion():
            return "orientations"


def _array(element: Quantity | Boolean) -> str:
    if isinstance(element, Boolean):
        return "an array of booleans"
    return f"an array of numbers{_in_unit(element)}"


def _in_unit(element: Quantity) -> str:
    if element.unit is None or is_plain(element):
        return ""
    return f" in {element.unit.symbol}"
