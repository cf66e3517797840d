"""Types in the words of the user."""

from __future__ import annotations

from rossmarie.types import (
    Array,
    Boolean,
    Box,
    Interval,
    Message,
    Quantity,
    Quaternion,
    Text,
    Type,
    Unsupported,
    Vector,
)
from rossmarie.units import DIMENSIONLESS


def describe(type_: Type) -> str:
    """`a vector in m/s`; `a text`."""
    if isinstance(type_, Quantity):
        return _quantity(type_)
    if isinstance(type_, Vector):
        return f"a vector{_in_unit(type_.element)}"
    if isinstance(type_, Array):
        truths = isinstance(type_.element, Boolean)
        return "an array of truths" if truths else f"an array of numbers{_in_unit(type_.element)}"
    if isinstance(type_, Message):
        return f"a message {type_.name}"
    words: dict[type[object], str] = {
        Boolean: "true or false",
        Text: "a string",
        Quaternion: "an orientation",
        Interval: "an interval",
        Box: "a box",
        Unsupported: "a field that rules cannot use",
    }
    return words.get(type(type_), "not known")


def describe_quantity(quantity: Quantity) -> str:
    """`m/s`, `a plain number`."""
    if quantity.unit is None:
        return "an unknown unit"
    return "a plain number" if is_plain(quantity) else quantity.unit.symbol


def is_plain(quantity: Quantity) -> bool:
    """Whether the number has the unit 1, or %."""
    return quantity.unit is not None and quantity.unit.dimension == DIMENSIONLESS.dimension


def _quantity(quantity: Quantity) -> str:
    if quantity.unit is None:
        return "a number of unknown unit"
    return "a plain number" if is_plain(quantity) else f"a number in {quantity.unit.symbol}"


def _in_unit(element: Quantity | Boolean) -> str:
    if isinstance(element, Boolean) or element.unit is None or is_plain(element):
        return ""
    return f" in {element.unit.symbol}"
