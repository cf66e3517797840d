"""Zones: their shapes, as numbers in m."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise

from dslkit.source import Span
from rossmarie import core
from rossmarie.check.expressions.infer import infer
from rossmarie.check.operations.operands import require_constant, scalar_operand
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import text_of
from rossmarie.check.units.errors import MisplacedUnit
from rossmarie.check.units.quantities import read_unit
from rossmarie.check.wording.describe import describe, is_plain
from rossmarie.check.zones.errors import CrossingPolygon, EmptyZone, UnfitShape
from rossmarie.check.zones.polygons import first_meeting
from rossmarie.syntax import ast
from rossmarie.types import Quantity, Region, Unknown
from rossmarie.units import Unit, parse_unit

_METRE = parse_unit("m")
_FARTHEST = 1e6
"""The distance in m from the origin of a frame within which a number with nine decimal places is
exact.
"""
_MOST_CORNERS = 1000
_LEAST_CORNERS = 3
_FORMS: Mapping[str, str] = {
    "box": "box [0.2, 0.9, -0.4, 0.4] m",
    "circle": "circle [0.9, 0] m radius 0.4 m",
    "polygon": "polygon [0, 1], [1, 1], [1, 2] m",
}
_NUMBERS: Mapping[str, tuple[int, str, str]] = {
    "box": (4, "a box", "four numbers, [XMIN, XMAX, YMIN, YMAX]"),
    "circle": (2, "the centre of a circle", "two numbers, [X, Y]"),
    "polygon": (2, "a corner", "two numbers, [X, Y]"),
}
"""The numbers in a bracket of each shape, with the words for the bracket."""


def check_zones(context: Context) -> None:
    """Check every zone of the program, and record the correct ones in `context.zones`."""
    for item in context.declarations.items:
        if isinstance(item, ast.Zone):
            found = _region(item, context)
            if found is not None:
                type_ = Region(
                    item.name.text, context.frames.named(item.frame.text), True, is_zone=True
                )
                context.zones.setdefault(item.name.text, (found, type_))


def _region(zone: ast.Zone, context: Context) -> core.Region | None:
    context.enter(None)
    if not zone.shapes:
        context.collector.add(EmptyZone(zone=zone.name.text).at(zone.name.span))
        return None
    name, about = f"zone_{zone.name.text}", f"zone {zone.name.text}"
    shapes: list[core.Shape] = []
    for number, shape in enumerate(zone.shapes, 1):
        word = shape.word.text
        named = f"{name}_{number}", f"{word} {number} of {about}"
        found = {"box": _box, "circle": _circle, "polygon": _polygon}[word](shape, *named, context)
        if found is not None:
            shapes.append(found)
    return core.Region(name, about, tuple(shapes)) if len(shapes) == len(zone.shapes) else None


# --- shapes ----------------------------------------------------------------------------------


def _box(shape: ast.Shape, name: str, about: str, context: Context) -> core.Shape | None:
    found = _places(shape, context)
    if found is None:
        return None
    ((left, right, lower, upper),) = found
    (bracket,) = shape.brackets
    is_right = True
    for axis, ends, nodes in (
        ("X", (left, right), bracket.elements[:2]),
        ("Y", (lower, upper), bracket.elements[2:]),
    ):
        if not ends[0] < ends[1]:
            expected = f"less than {axis}MAX"
            text = f"{text_of(nodes[0])}, and {axis}MAX {text_of(nodes[1])}"
            _report(f"{axis}MIN of a box", expected, text, shape, nodes[0].span, context)
            is_right = False
    return core.Rectangle(name, about, (left, lower), (right, upper)) if is_right else None


def _circle(shape: ast.Shape, name: str, about: str, context: Context) -> core.Shape | None:
    found, node = _places(shape, context), shape.radius
    assert node is not None, "the grammar asks for it"
    infer(node, context)
    radius = _length(node, None, shape, context)
    if found is None or radius is None:
        return None
    if radius <= 0.0:
        _report("a radius", "more than zero", text_of(node), shape, node.span, context)
        return None
    (centre,) = found
    return core.Circle(name, about, (centre[0], centre[1]), radius)


def _polygon(shape: ast.Shape, name: str, about: str, context: Context) -> core.Shape | None:
    found = _places(shape, context)
    if found is None:
        return None
    corners = tuple((x, y) for x, y in found)
    count = len(corners)
    if not _LEAST_CORNERS <= count <= _MOST_CORNERS:
        expected = f"given by {_LEAST_CORNERS} to {_MOST_CORNERS} corners"
        _report("a polygon", expected, f"one of {count}", shape, shape.span, context)
        return None
    if _repeats(shape, corners, context):
        return None
    meeting = first_meeting(corners)
    if meeting is None:
        return core.Polygon(name, about, corners)
    edge, other = (shape.brackets[number] for number in meeting)
    finding = CrossingPolygon(edge=text_of(edge))
    place = finding.Other(edge=text_of(other)).at(other.span)
    context.collector.add(finding.at(edge.span, place))
    return None


def _repeats(shape: ast.Shape, corners: Sequence[tuple[float, float]], context: Context) -> bool:
    """Say whether two adjacent corners are equal. Report them if so."""
    for number, (corner, following) in enumerate(pairwise((*corners, corners[0])), 1):
        if corner != following:
            continue
        is_last = number == len(corners)
        bracket = shape.brackets[-1 if is_last else number]
        found = f"the {'first' if is_last else 'same'} one again"
        finding = _unfit("a corner", "different from the previous corner", found, shape)
        help = finding.FirstAgain() if is_last else None
        context.collector.add(finding.at(bracket.span, help=help))
        return True
    return False


# --- numbers ---------------------------------------------------------------------------------


def _places(shape: ast.Shape, context: Context) -> list[tuple[float, ...]] | None:
    """The numbers in m of each bracket of a shape. A unit after the last bracket applies to all."""
    units = [each.unit for each in shape.brackets]
    own = units if any(units[:-1]) else [units[-1] for _ in units]
    places = []
    for bracket, unit in zip(shape.brackets, own, strict=True):
        found = _numbers(bracket, unit, shape, context)
        if found is None:
            return None
        places.append(found)
    return places


def _numbers(
    bracket: ast.Bracket, written: ast.Unit | None, shape: ast.Shape, context: Context
) -> tuple[float, ...] | None:
    for element in bracket.elements:
        infer(element, context)
    count, part, expected = _NUMBERS[shape.word.text]
    if len(bracket.elements) != count:
        text = f"one of {len(bracket.elements)}"
        _report(part, expected, text, shape, bracket.span, context)
        return None
    unit = None if written is None else _unit(written, shape, context)
    if written is not None and unit is None:
        return None
    numbers = []
    for element in bracket.elements:
        number = _length(element, unit, shape, context)
        if number is None:
            return None
        numbers.append(number)
    return tuple(numbers)


def _unit(written: ast.Unit, shape: ast.Shape, context: Context) -> Unit | None:
    unit = read_unit(written, context.collector)
    if unit is None or unit.dimension == _METRE.dimension:
        return unit
    _report(
        f"a {shape.word.text}", "in a unit of length", unit.symbol, shape, written.span, context
    )
    return None


def _length(
    node: ast.Expression, unit: Unit | None, shape: ast.Shape, context: Context
) -> float | None:
    """A constant in m; None after reporting. `unit` is the unit of the whole bracket."""
    if isinstance(context.type_of(node), Unknown):
        return None
    operand = scalar_operand(node, context)
    if operand is None or not require_constant(node, f"a number of a {shape.word.text}", context):
        return None
    if not _has_unit(node, operand.quantity, unit, shape, context):
        return None
    number = context.values[node].numbers[0]
    number = number if unit is None else unit.to_si(number)
    if math.isfinite(number) and abs(number) <= _FARTHEST:
        return number
    expected = f"at most {_FARTHEST:g} m from the origin"
    part = f"a number of a {shape.word.text}"
    _report(part, expected, f"{number:g} m", shape, node.span, context)
    return None


def _has_unit(
    node: ast.Expression, found: Quantity, unit: Unit | None, shape: ast.Shape, context: Context
) -> bool:
    """Say whether a number has the unit that it needs: a length, or no unit if one unit applies to
    all numbers.
    """
    if unit is not None and not is_plain(found):
        finding = MisplacedUnit(reason="both this number and the whole list have a unit")
        help = finding.OnceInList(unit=unit.symbol)
        context.collector.add(finding.at(node.span, help=help))
        return False
    is_length = found.unit is not None and found.unit.dimension == _METRE.dimension
    if unit is None and not is_length:
        part = f"a number of a {shape.word.text}"
        _report(part, "in m", describe(found), shape, node.span, context)
        return False
    return True


def _unfit(part: str, expected: str, found: str, shape: ast.Shape) -> UnfitShape:
    form = _FORMS[shape.word.text]
    return UnfitShape(part=part, expected=expected, found=found, form=form)


def _report(
    part: str, expected: str, found: str, shape: ast.Shape, span: Span, context: Context
) -> None:
    context.collector.add(_unfit(part, expected, found, shape).at(span))
