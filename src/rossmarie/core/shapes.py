"""The shapes of regions, and the functions of one shape (S63, S64, S81).

The numbers of a shape are known at compile time: they are constants in the expressions of its
functions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

from rossmarie.core.expressions import (
    ConstantNumber,
    Expression,
    Local,
    Operand,
    Subfunction,
    choose,
    square_root,
)

Corner = tuple[float, float]
"""x and y in m."""


@dataclass(frozen=True)
class Polygon:
    """The corners of a polygon, in either direction, or the one corner of a point. `name` is unique
    among the shapes of a program, and `about` describes the shape.
    """

    name: str
    about: str
    corners: tuple[Corner, ...]


@dataclass(frozen=True)
class Rectangle:
    """A rectangle between two corners; `low` has the lower x and y. Its edges belong to it."""

    name: str
    about: str
    low: Corner
    high: Corner

    @property
    def corners(self) -> tuple[Corner, ...]:
        """The four corners."""
        (left, right), (lower, upper) = zip(self.low, self.high, strict=True)
        return ((left, lower), (right, lower), (right, upper), (left, upper))


@dataclass(frozen=True)
class Circle:
    """A disc with a `radius` in m around `centre`."""

    name: str
    about: str
    centre: Corner
    radius: float

    @property
    def corners(self) -> tuple[Corner, ...]:
        """The outermost points along both axes."""
        (x, y), r = self.centre, self.radius
        return ((x + r, y), (x, y + r), (x - r, y), (x, y - r))


Shape = Polygon | Rectangle | Circle


def has_area(shape: Shape) -> bool:
    """Say whether a shape has an interior."""
    return len(shape.corners) > 1


# --- inside ----------------------------------------------------------------------------------


@cache
def inside_of(shape: Shape) -> Subfunction:
    """1 inside the shape, else 0."""
    match shape:
        case Polygon():
            found = _in_polygon(shape)
        case Rectangle(low=(left, lower), high=(right, upper)):
            found = ConstantNumber(1.0)
            for beyond in (upper < _Y, lower > _Y, right < _X, left > _X):
                found = choose(beyond, 0.0, found)
        case Circle(radius=radius):
            found = choose(_square_from_centre(shape) > radius * radius, 0.0, 1.0)
    return of_point(f"in_{shape.name}", found, f"1 if ({{0}}, {{1}}) is in {shape.about}, else 0")


def _in_polygon(polygon: Polygon) -> Expression:
    """S63: 1 inside the polygon, else 0. Points outside the bounding box are decided at once."""
    xs, ys = zip(*polygon.corners, strict=True)
    edges = [edge for edge in map(_upwards, _edges(polygon)) if edge]
    name, about = f"crossings_{polygon.name}", f"edges of {polygon.about}"
    found: Expression = _crossings(name, about, edges)(_X, _Y)
    for condition in (max(ys) < _Y, min(ys) > _Y, max(xs) < _X, min(xs) > _X):
        found = choose(condition, 0.0, found)
    return found


def _crossings(name: str, about: str, edges: Sequence[_Edge]) -> Subfunction:
    """1 if the ray from a point crosses an odd number of edges. If there are many edges, only the
    edges at the height of the point are tested; other edges count 0.
    """
    middle = sorted(lower for _, lower, _, _ in edges)[len(edges) // 2]
    below = [edge for edge in edges if edge[1] < middle]
    above = [edge for edge in edges if edge[3] > middle]
    most = len(edges) * _MOST_IN_HALF
    if len(edges) <= _ALL_AT_ONCE or len(below) > most or len(above) > most:
        crossed = [_CROSSES(_X, _Y, *map(ConstantNumber, edge)) for edge in edges]
        return together(name, about, crossed, chain(_ODD))
    halves = (
        _crossings(f"{name}_below", f"{about} below {middle:g}", below),
        _crossings(f"{name}_above", f"{about} above {middle:g}", above),
    )
    of_half, of_other = (half(_X, _Y) for half in halves)
    words = f"the {about} at ({{0}}, {{1}})"
    return of_point(f"{name}_split", choose(middle > _Y, of_half, of_other), words)


_Edge = tuple[float, float, float, float]
"""x and y of the lower end of an edge, then of the upper end."""
_ALL_AT_ONCE = 12
"""The number of edges up to which all edges are tested, instead of half of them."""
_MOST_IN_HALF = 0.75
"""The share of edges in one half above which halving is not worthwhile."""


def _upwards(edge: tuple[Corner, Corner]) -> _Edge | None:
    """An edge from its lower end to its upper end; None for a horizontal edge."""
    (ax, ay), (bx, by) = sorted(edge, key=lambda corner: corner[1])
    return None if ay == by else (ax, ay, bx, by)


def _crossing() -> Expression:
    """S63: the lower end of an edge belongs to it, the upper end does not."""
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


@cache
def square_of(shape: Polygon | Rectangle) -> Subfunction:
    """The squared distance from a shape or a point; 0 inside the shape."""
    if isinstance(shape, Rectangle):
        found = _from_rectangle(shape)
    elif len(shape.corners) == 1:
        ((ax, ay),) = shape.corners
        found = (_X - ax) * (_X - ax) + (_Y - ay) * (_Y - ay)
    else:
        edges = [_TO_EDGE(_X, _Y, *map(ConstantNumber, (*a, *b))) for a, b in _edges(shape)]
        name, about = f"square_edges_{shape.name}", f"edges of {shape.about}"
        beyond = together(name, about, edges, chain(LESSER))(_X, _Y)
        found = choose(inside_of(shape)(_X, _Y).equals(1.0), 0.0, beyond)
    about = f"the square of the distance of ({{0}}, {{1}}) from {shape.about}"
    return of_point(f"square_{shape.name}", found, about)


@cache
def gap_of(circle: Circle) -> Subfunction:
    """S81: the distance from a circle; 0 inside the circle, and unknown for an unknown point."""
    gap = Local("gap", square_root(_square_from_centre(circle)) - circle.radius)
    about = f"the distance of ({{0}}, {{1}}) from {circle.about}"
    return of_point(f"gap_{circle.name}", choose(gap < 0.0, 0.0, gap), about)


def _square_from_centre(circle: Circle) -> Expression:
    cx, cy = circle.centre
    return (_X - cx) * (_X - cx) + (_Y - cy) * (_Y - cy)


def _from_rectangle(shape: Rectangle) -> Expression:
    """S81: the distance along each axis."""
    gaps = []
    for name, number, low, high in zip("xy", (_X, _Y), shape.low, shape.high, strict=True):
        nothing = number - number  # 0; unknown if the number is unknown
        beyond = choose(number > high, number - high, nothing)
        gaps.append(Local(f"d{name}", choose(number < low, low - number, beyond)))
    dx, dy = gaps
    return dx * dx + dy * dy


def _edge_square() -> Expression:
    """S64: the squared distance from the nearest point of the edge."""
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
LESSER = Subfunction(
    "lesser_square",
    ("a", "b"),
    choose(Operand(0) < Operand(1), Operand(0), Operand(1)),
    "the lesser of {0} and {1}",
)


# --- many parts --------------------------------------------------------------------------------

_X, _Y = Operand(0), Operand(1)
_MOST = 32
"""The greatest number of parts in one expression: compilers and Python limit the depth of
nesting.
"""

Combine = Callable[[Sequence[Expression]], Expression]


def of_point(name: str, expression: Expression, about: str) -> Subfunction:
    """A function of x and y."""
    return Subfunction(name, ("x", "y"), expression, about)


def together(name: str, about: str, parts: Sequence[Expression], combine: Combine) -> Subfunction:
    """A function of x and y that combines some parts."""
    if len(parts) <= _MOST:
        return of_point(f"{name}_together", combine(parts), f"the {about} at ({{0}}, {{1}})")
    groups = []
    for start in range(0, len(parts), _MOST):
        some = f"{about}, {_MOST} from the {start + 1}th on"
        group = together(f"{name}_{start}", some, parts[start : start + _MOST], combine)
        groups.append(group(_X, _Y))
    return together(name, about, groups, combine)


def first(parts: Sequence[Expression]) -> Expression:
    """1 if one of the parts is 1, else 0. C stops at the first such part."""
    found: Expression = ConstantNumber(0.0)
    for part in reversed(parts):
        found = choose(part.equals(1.0), 1.0, found)
    return found


def chain(function: Subfunction) -> Combine:
    """All parts, combined from the first to the last."""

    def combined(parts: Sequence[Expression]) -> Expression:
        found: Expression = ConstantNumber(0.0)
        for number, part in enumerate(parts):
            found = Local(f"from_{number}", function(found, part) if number else part)
        return found

    return combined
