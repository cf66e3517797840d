"""The functions of a region: whether a point lies in it, and how far away it is (S63, S64, S81).

A region is some shapes in a plane, known when compiling. So its functions are like those of
`functions.py`, but for their numbers: each shape is a subfunction, with its corners as they stand
in the rules.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Sequence
from dataclasses import dataclass

from rossmarie.core.expressions import (
    UNKNOWN,
    Condition,
    Either,
    Expression,
    IsUnknown,
    Local,
    Number,
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
    """A case in which a function is easy to compute: where these conditions on its operands hold,
    it is that expression.
    """

    conditions: tuple[Condition, ...]
    value: Expression


class Measure(enum.Enum):
    """The functions of a region, of x and y."""

    INSIDE = "inside"
    DISTANCE = "distance"


@dataclass(frozen=True)
class Region:
    """Shapes in the plane of a frame: all things of a class, say, or a zone."""

    name: str
    about: str
    shapes: tuple[Shape, ...]


@dataclass(frozen=True)
class RegionFunction:
    """A function of a point that a region has. Its operands are x and y in m, the frame that the
    point is seen from, and the frame of the region: numbers of texts.
    """

    measure: Measure
    region: Region

    @property
    def value(self) -> str:
        """`inside_corridor`, as functions are called in the languages of targets."""
        return f"{self.measure.value}_{self.region.name}"

    def __hash__(self) -> int:
        return hash(self.value)  # corners are many, and tell no more


OPERANDS = 4
"""x, y, the frame of the point, and that of the region."""

_ABOUT = {
    Measure.INSIDE: "whether ({0}, {1}) is in {region}",
    Measure.DISTANCE: "the distance of ({0}, {1}) from {region}",
}
RULES = {Measure.INSIDE: "S63", Measure.DISTANCE: "S64"}
"""The rules of the semantics."""


def phrase(function: RegionFunction) -> str:
    """The function in words, with `{0}` to `{3}` for operands."""
    return _ABOUT[function.measure].replace("{region}", function.region.about)


def define(function: RegionFunction, operands: Sequence[Expression]) -> Expression:
    """The expression of the function."""
    x, y, seen, wanted = operands
    found = {Measure.INSIDE: _inside, Measure.DISTANCE: _distance}[function.measure]
    known = choose(seen.equals(wanted), found(function.region, x, y), UNKNOWN)
    return choose(Either(IsUnknown(x), IsUnknown(y)), UNKNOWN, known)


# --- inside and distance -----------------------------------------------------------------------

_X, _Y = Operand(0), Operand(1)


def _inside(region: Region, x: Expression, y: Expression) -> Expression:
    """S63: in one shape at least."""
    parts = [inside_of(each)(_X, _Y) for each in region.shapes if has_area(each)]
    if not parts:
        return Number(0.0)
    return together(f"in_{region.name}", f"shapes of {region.about}", parts, first)(x, y)


def _distance(region: Region, x: Expression, y: Expression) -> Expression:
    """S64: the root of the least square, and S81: or the way to a circle."""
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
    # A NaN has a sign, which depends on the machine.
    return choose(IsUnknown(least), UNKNOWN, least)


# --- what solvers may know ---------------------------------------------------------------------

_SLACK = 2.0**-40
"""More than the roundings in a distance can add, with a billionth of a metre."""
_FEW = 24
"""Edges through which solvers find their way in a second or two."""


def bounds(
    function: RegionFunction, result: Expression, operands: Sequence[Expression]
) -> tuple[Condition, ...] | None:
    """The facts from which solvers go where the formula is too much for them; None if it is not."""
    xs, ys = zip(*(each for part in function.region.shapes for each in part.corners), strict=True)
    if function.measure is Measure.INSIDE:
        return _bounds_of_inside(xs, ys, result, operands) if len(xs) > _FEW else None
    return _bounds_of_distance(xs, ys, result, operands)


def _bounds_of_inside(
    xs: Sequence[float], ys: Sequence[float], result: Expression, operands: Sequence[Expression]
) -> tuple[Condition, ...]:
    """Nothing is inside beyond the corners."""
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
    """It is no less than that from the box around all corners along each axis, and no greater than
    the way along both axes to the first corner.
    """
    beyond = [
        part for number, ends in zip(operands, (xs, ys), strict=False)
        for part in (min(ends) - number, number - max(ends))
    ]  # fmt: skip
    way = abs(operands[0] - xs[0]) + abs(operands[1] - ys[0])
    least = [part * (1.0 - _SLACK) - 1e-9 < result for part in beyond]
    return (*least, result < way * (1.0 + _SLACK) + 1e-9)


def easy(function: RegionFunction, operands: Sequence[Expression]) -> tuple[Easy, ...]:
    """The distance beside the corner that is farthest along x, in that direction; of a box, beside
    the whole of that edge.
    """
    x, y, seen, wanted = operands
    shape = max(function.region.shapes, key=lambda each: max(each.corners))
    end = max(shape.corners)
    level: list[Condition] = [y.equals(end[1])]
    if isinstance(shape, Rectangle):
        low, high = shape.low[1], shape.high[1]
        level = [Either(y > low, y.equals(low)), Either(y < high, y.equals(high))]
    beside = (seen.equals(wanted), *level)
    return (Easy((*beside, x > end[0]), x - end[0]), Easy((*beside, x.equals(end[0])), Number(0.0)))


def range_of(function: RegionFunction) -> tuple[float, float]:
    """The numbers that can come out."""
    return (0.0, 1.0) if function.measure is Measure.INSIDE else (0.0, math.inf)
