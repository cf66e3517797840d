"""The functions of a region: whether a point is in it, and the distance to it (S63, S64, S81).

A region consists of shapes in a plane, known at compile time. Its functions are like those of
`functions.py`, except for their numbers: each shape is a subfunction that contains the corners from
the rules.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Sequence
from dataclasses import dataclass

from rossmarie.core.expressions import (
    UNKNOWN,
    Condition,
    ConstantNumber,
    Either,
    Expression,
    IsUnknown,
    Local,
    Operand,
    choose,
    square_root,
)
from rossmarie.core.shapes import (
    LESSER,
    Circle,
    Rectangle,
    Shape,
    chain,
    first,
    gap_of,
    has_area,
    inside_of,
    square_of,
    together,
)


@dataclass(frozen=True)
class Easy:
    """A case in which a function is easy to compute: if these conditions on its operands are true,
    the function equals the expression.
    """

    conditions: tuple[Condition, ...]
    value: Expression


class RegionMeasure(enum.Enum):
    """The functions of a region, of x and y in m."""

    INSIDE = "inside"
    DISTANCE = "distance"


@dataclass(frozen=True)
class Region:
    """Shapes in the plane of a frame, for example all individuals of a class, or a zone."""

    name: str
    about: str
    shapes: tuple[Shape, ...]


@dataclass(frozen=True)
class RegionFunction:
    """A function of a point, for one region. Its operands are x and y in m, the frame of the point,
    and the frame of the region; frames are numbers of texts.
    """

    measure: RegionMeasure
    region: Region

    @property
    def value(self) -> str:
        """`inside_corridor`, the name of the function in target languages."""
        return f"{self.measure.value}_{self.region.name}"

    def __hash__(self) -> int:
        return hash(self.value)  # the many corners would not help a reader


OPERANDS = 4
"""x, y, the frame of the point, and the frame of the region."""

_ABOUT = {
    RegionMeasure.INSIDE: "whether ({0}, {1}) is in {region}",
    RegionMeasure.DISTANCE: "the distance of ({0}, {1}) from {region}",
}
RULES = {RegionMeasure.INSIDE: "S63", RegionMeasure.DISTANCE: "S64"}
"""The rules of the semantics."""


def phrase(function: RegionFunction) -> str:
    """The function in words, with `{0}` to `{3}` for operands."""
    return _ABOUT[function.measure].replace("{region}", function.region.about)


def define(function: RegionFunction, operands: Sequence[Expression]) -> Expression:
    """The expression of the function."""
    x, y, seen, wanted = operands
    found = {RegionMeasure.INSIDE: _inside, RegionMeasure.DISTANCE: _distance}[function.measure]
    known = choose(seen.equals(wanted), found(function.region, x, y), UNKNOWN)
    return choose(Either(IsUnknown(x), IsUnknown(y)), UNKNOWN, known)


# --- inside and distance -----------------------------------------------------------------------

_X, _Y = Operand(0), Operand(1)


def _inside(region: Region, x: Expression, y: Expression) -> Expression:
    """S63: in at least one shape."""
    parts = [inside_of(each)(_X, _Y) for each in region.shapes if has_area(each)]
    if not parts:
        return ConstantNumber(0.0)
    return together(f"in_{region.name}", f"shapes of {region.about}", parts, first)(x, y)


def _distance(region: Region, x: Expression, y: Expression) -> Expression:
    """S64: the root of the least square; and S81: the distance to a circle."""
    squares = [square_of(each)(_X, _Y) for each in region.shapes if not isinstance(each, Circle)]
    gaps = [gap_of(each)(_X, _Y) for each in region.shapes if isinstance(each, Circle)]
    found: list[Expression] = []
    if squares:
        name, about = f"square_{region.name}", f"shapes of {region.about}"
        found.append(square_root(together(name, about, squares, chain(LESSER))(x, y)))
    if gaps:
        name, about = f"gap_{region.name}", f"circles of {region.about}"
        found.append(together(name, about, gaps, chain(LESSER))(x, y))
    least = Local("least", LESSER(*found) if len(found) > 1 else found[0])
    # The sign of a NaN depends on the processor.
    return choose(IsUnknown(least), UNKNOWN, least)


# --- facts for solvers -------------------------------------------------------------------

_SLACK = 2.0**-40
"""A margin above the rounding errors in a distance, plus a billionth of a metre."""
_FEW = 24
"""The number of edges that solvers can handle in a second or two."""


def bounds(
    function: RegionFunction, result: Expression, operands: Sequence[Expression]
) -> tuple[Condition, ...] | None:
    """Facts that solvers use when the formula is too complex for them; None if the formula is
    simple enough.
    """
    xs, ys = zip(*(each for part in function.region.shapes for each in part.corners), strict=True)
    if function.measure is RegionMeasure.INSIDE:
        return _bounds_of_inside(xs, ys, result, operands) if len(xs) > _FEW else None
    return _bounds_of_distance(xs, ys, result, operands)


def _bounds_of_inside(
    xs: Sequence[float], ys: Sequence[float], result: Expression, operands: Sequence[Expression]
) -> tuple[Condition, ...]:
    """Bounds: no point outside the bounding box of the corners is inside."""
    outside = result.equals(0.0)
    found: list[Condition] = [Either(outside, result.equals(1.0))]
    for number, ends in zip(operands, (xs, ys), strict=False):
        for within in (number < max(ends), number > min(ends)):
            on_the_edge = Either(number.equals(max(ends)), number.equals(min(ends)))
            found.append(Either(outside, Either(within, on_the_edge)))
    return tuple(found)


def _bounds_of_distance(
    xs: Sequence[float], ys: Sequence[float], result: Expression, operands: Sequence[Expression]
) -> tuple[Condition, ...]:
    """Bounds: the distance is at least the distance to the bounding box along each axis, and at
    most the sum of the distances to the first corner along both axes.
    """
    beyond = [
        part for number, ends in zip(operands, (xs, ys), strict=False)
        for part in (min(ends) - number, number - max(ends))
    ]  # fmt: skip
    distance = abs(operands[0] - xs[0]) + abs(operands[1] - ys[0])
    least = [part * (1.0 - _SLACK) - 1e-9 < result for part in beyond]
    return (*least, result < distance * (1.0 + _SLACK) + 1e-9)


def easy(function: RegionFunction, operands: Sequence[Expression]) -> tuple[Easy, ...]:
    """Easy cases: the distance beyond the corner with the largest x, in that direction; for a box,
    beyond the whole edge there.
    """
    x, y, seen, wanted = operands
    shape = max(function.region.shapes, key=lambda each: max(each.corners))
    end = max(shape.corners)
    level: list[Condition] = [y.equals(end[1])]
    if isinstance(shape, Rectangle):
        low, high = shape.low[1], shape.high[1]
        level = [Either(y > low, y.equals(low)), Either(y < high, y.equals(high))]
    beside = (seen.equals(wanted), *level)
    return (
        Easy((*beside, x > end[0]), x - end[0]),
        Easy((*beside, x.equals(end[0])), ConstantNumber(0.0)),
    )


def range_of(function: RegionFunction) -> tuple[float, float]:
    """The range of the results."""
    return (0.0, 1.0) if function.measure is RegionMeasure.INSIDE else (0.0, math.inf)
