"""The functions of a region: whether a point lies in it, and how far away it is (S63, S64).

A region is some polygons and points in a plane, known when compiling. So its functions are like
those of `functions.py`, but for their numbers: each polygon is a subfunction, with its corners as
they stand in the rules.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

from rossmarie.core.expressions import (
    UNKNOWN,
    Condition,
    Either,
    Expression,
    IsUnknown,
    Local,
    Number,
    Operand,
    Subfunction,
    choose,
    square_root,
)

Corner = tuple[float, float]
"""x and y in m."""


@dataclass(frozen=True)
class Polygon:
    """The corners of a polygon, anticlockwise; or the one corner of a point. `name` is a word that
    no other polygon of a program has, and `about` says what it is.
    """

    name: str
    about: str
    corners: tuple[Corner, ...]


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
    """Polygons and points in the plane of a frame: all things of a class, say."""

    name: str
    about: str
    polygons: tuple[Polygon, ...]


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


# --- inside ----------------------------------------------------------------------------------


def _inside(region: Region, x: Expression, y: Expression) -> Expression:
    """S63: in one polygon at least."""
    parts = [_inside_of(each)(_X, _Y) for each in region.polygons if len(each.corners) > 1]
    if not parts:
        return Number(0.0)
    return _together(f"in_{region.name}", f"polygons of {region.about}", parts, _first)(x, y)


@cache
def _inside_of(polygon: Polygon) -> Subfunction:
    """S63: a point beyond the corners is not looked at further."""
    xs, ys = zip(*polygon.corners, strict=True)
    edges = [
        _CROSSES(_X, _Y, *map(Number, edge)) for edge in map(_upwards, _edges(polygon)) if edge
    ]
    name, about = f"crossings_{polygon.name}", f"edges of {polygon.about}"
    found: Expression = _together(name, about, edges, _chain(_ODD))(_X, _Y)
    for condition in (max(ys) < _Y, min(ys) > _Y, max(xs) < _X, min(xs) > _X):
        found = choose(condition, 0.0, found)
    about = f"1 if ({{0}}, {{1}}) is in {polygon.about}, else 0"
    return _of_point(f"in_{polygon.name}", found, about)


def _upwards(edge: tuple[Corner, Corner]) -> tuple[float, ...]:
    """An edge from its lower end to its upper one; nothing of one that is level."""
    (ax, ay), (bx, by) = sorted(edge, key=lambda corner: corner[1])
    return () if ay == by else (ax, ay, bx, by)


def _crossing() -> Expression:
    """S63: the lower end of an edge counts, the upper one does not."""
    x, y, ax, ay, bx, by = map(Operand, range(6))
    is_before = (x - ax) * (by - ay) < (y - ay) * (bx - ax)
    return choose(y < ay, 0.0, choose(y < by, choose(is_before, 1.0, 0.0), 0.0))


_CROSSES = Subfunction(
    "crosses",
    ("x", "y", "ax", "ay", "bx", "by"),
    _crossing(),
    "1 if ({0}, {1}) is before the edge from ({2}, {3}) up to ({4}, {5}), else 0",
)
_ODD = Subfunction(
    "odd",
    ("a", "b"),
    choose(Operand(0).equals(Operand(1)), 0.0, 1.0),
    "1 if one of {0} and {1} is 1, else 0",
)


def _edges(polygon: Polygon) -> list[tuple[Corner, Corner]]:
    corners = polygon.corners
    return list(zip(corners, (*corners[1:], corners[0]), strict=True))


# --- distance --------------------------------------------------------------------------------


def _distance(region: Region, x: Expression, y: Expression) -> Expression:
    """S64: the root of the least square."""
    squares = [_square_of(each)(_X, _Y) for each in region.polygons]
    name, about = f"square_{region.name}", f"polygons of {region.about}"
    found = square_root(_together(name, about, squares, _chain(_LESSER))(x, y))
    # A NaN has a sign, which depends on the machine.
    return choose(IsUnknown(found), UNKNOWN, found)


@cache
def _square_of(polygon: Polygon) -> Subfunction:
    """The square of the distance from a polygon, 0 inside of it; or from a point."""
    if len(polygon.corners) == 1:
        ((ax, ay),) = polygon.corners
        found: Expression = (_X - ax) * (_X - ax) + (_Y - ay) * (_Y - ay)
    else:
        edges = [_TO_EDGE(_X, _Y, *map(Number, (*a, *b))) for a, b in _edges(polygon)]
        name, about = f"square_edges_{polygon.name}", f"edges of {polygon.about}"
        beyond = _together(name, about, edges, _chain(_LESSER))(_X, _Y)
        found = choose(_inside_of(polygon)(_X, _Y).equals(1.0), 0.0, beyond)
    about = f"the square of the distance of ({{0}}, {{1}}) from {polygon.about}"
    return _of_point(f"square_{polygon.name}", found, about)


def _edge_square() -> Expression:
    """S64: from the point of the edge that is nearest."""
    x, y, ax, ay, bx, by = map(Operand, range(6))
    dx, dy = Local("dx", bx - ax), Local("dy", by - ay)
    along = Local("along", ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy))
    cut = Local("cut", choose(along < 0.0, 0.0, choose(along > 1.0, 1.0, along)))
    ex, ey = Local("ex", x - (ax + cut * dx)), Local("ey", y - (ay + cut * dy))
    return ex * ex + ey * ey


_TO_EDGE = Subfunction(
    "square_of_edge",
    ("x", "y", "ax", "ay", "bx", "by"),
    _edge_square(),
    "the square of the distance of ({0}, {1}) from the edge from ({2}, {3}) to ({4}, {5})",
)
_LESSER = Subfunction(
    "lesser_square",
    ("a", "b"),
    choose(Operand(0) < Operand(1), Operand(0), Operand(1)),
    "the lesser of {0} and {1}",
)


# --- many parts --------------------------------------------------------------------------------

_X, _Y = Operand(0), Operand(1)
_MOST = 32
"""Parts of one expression: compilers and Python bound how deep one may lie in another."""

_Combine = Callable[[Sequence[Expression]], Expression]


def _of_point(name: str, expression: Expression, about: str) -> Subfunction:
    return Subfunction(name, ("x", "y"), expression, about)


def _together(name: str, about: str, parts: Sequence[Expression], combine: _Combine) -> Subfunction:
    """A function of x and y that combines its parts."""
    if len(parts) <= _MOST:
        return _of_point(f"{name}_together", combine(parts), f"the {about} at ({{0}}, {{1}})")
    groups = []
    for start in range(0, len(parts), _MOST):
        some = f"{about}, {_MOST} from the {start + 1}th on"
        group = _together(f"{name}_{start}", some, parts[start : start + _MOST], combine)
        groups.append(group(_X, _Y))
    return _together(name, about, groups, combine)


def _first(parts: Sequence[Expression]) -> Expression:
    """1 if one of them is 1, else 0: C stops at the first."""
    found: Expression = Number(0.0)
    for part in reversed(parts):
        found = choose(part.equals(1.0), 1.0, found)
    return found


def _chain(function: Subfunction) -> _Combine:
    """All of them, from the first to the last."""

    def combined(parts: Sequence[Expression]) -> Expression:
        found: Expression = Number(0.0)
        for number, part in enumerate(parts):
            found = Local(f"from_{number}", function(found, part) if number else part)
        return found

    return combined


# --- what solvers may know ---------------------------------------------------------------------

_SLACK = 2.0**-40
"""More than the roundings in a distance can add, with a billionth of a metre."""
_FEW = 24
"""Edges through which solvers find their way in a second or two."""


def bounds(
    function: RegionFunction, result: Expression, operands: Sequence[Expression]
) -> tuple[Condition, ...] | None:
    """The facts from which solvers go where the formula is too much for them; None if it is not."""
    xs, ys = zip(*(each for part in function.region.polygons for each in part.corners), strict=True)
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
    """The distance at the corner that is farthest along x, and beyond it in that direction."""
    x, y, seen, wanted = operands
    end = max(corner for part in function.region.polygons for corner in part.corners)
    level = (seen.equals(wanted), y.equals(end[1]))
    return (Easy((*level, x > end[0]), x - end[0]), Easy((*level, x.equals(end[0])), Number(0.0)))


def range_of(function: RegionFunction) -> tuple[float, float]:
    """The numbers that can come out."""
    return (0.0, 1.0) if function.measure is Measure.INSIDE else (0.0, math.inf)
