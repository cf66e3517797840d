"""The points of a scan: their distance and direction, as signals of a machine (S72)."""

from __future__ import annotations

from dataclasses import replace

from rossmarie import ir
from rossmarie.check.names.parts import MessagePart
from rossmarie.lowering.inputs import InputLowering, InputPart
from rossmarie.lowering.nodes import Nodes, Shown
from rossmarie.types import AXES, Quantity
from rossmarie.units import parse_unit

ANGLE = Quantity(parse_unit("rad"))


def is_of_point(place: InputPart) -> bool:
    """Say whether a part is a coordinate of a point of a scan."""
    *before, last = place.path
    return tuple(before[-2:]) == (ir.RETURNS, ir.EACH) and last in AXES


def coordinate(
    place: InputPart, distance_type: Quantity, shown: Shown, inputs: InputLowering, nodes: Nodes
) -> int:
    """The signal of a coordinate of the current point, in the frame of the scanner."""
    *before, axis = place.path

    def column(name: str, type_: Quantity) -> int:
        index = inputs.column(InputPart(place.input, MessagePart((*before, name))), type_)
        text = f"{shown.text.rpartition('.')[0]}.{name}"
        return nodes.signal(ir.Element(index), replace(shown, text=text, unit=type_.unit))

    distance = column("range", distance_type)
    if axis == "z":
        return nodes.apply(ir.Function.MULTIPLY, (distance, nodes.constant(0.0, shown)), shown)
    wave = ir.Function.COSINE if axis == "x" else ir.Function.SINE
    share = nodes.apply(wave, (column("angle", ANGLE),), replace(shown, unit=None))
    return nodes.apply(ir.Function.MULTIPLY, (distance, share), shown)
