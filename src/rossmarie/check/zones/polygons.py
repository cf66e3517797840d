"""Polygons: an exact test whether their edges meet other than at their corners."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations

Corner = tuple[float, float]
_Edge = tuple[Corner, Corner]


def first_meeting(corners: Sequence[Corner]) -> tuple[int, int] | None:
    """The first two edges that meet other than at their common corner, by the numbers of their
    first corners; None if the polygon is simple. No two adjacent corners are equal.
    """
    edges = list(zip(corners, (*corners[1:], corners[0]), strict=True))
    return next(_meetings(edges), None)


def _meetings(edges: Sequence[_Edge]) -> Iterator[tuple[int, int]]:
    for (number, edge), (other_number, other) in combinations(enumerate(edges), 2):
        if not _are_near(edge, other):
            continue
        if edge[1] == other[0] and edge[0] == other[1]:
            yield number, other_number
        elif edge[1] == other[0] and other_number == number + 1:
            if _turns_back(edge, other):
                yield number, other_number
        elif other[1] == edge[0] and number == 0 and other_number == len(edges) - 1:
            if _turns_back(other, edge):
                yield number, other_number
        elif _touch(edge, other):
            yield number, other_number


def _are_near(edge: _Edge, other: _Edge) -> bool:
    """Say whether the bounding boxes of two edges touch."""
    for axis in (0, 1):
        low, high = sorted(end[axis] for end in edge)
        other_low, other_high = sorted(end[axis] for end in other)
        if high < other_low or other_high < low:
            return False
    return True


def _turns_back(edge: _Edge, following: _Edge) -> bool:
    """Say whether an edge runs back over the edge before it."""
    (a, b), (_, c) = edge, following
    (ax, ay), (bx, by), (cx, cy) = (tuple(map(Fraction, each)) for each in (a, b, c))
    is_back = (bx - ax) * (cx - bx) + (by - ay) * (cy - by) < 0
    return is_back and _side(a, b, c) == 0


def _touch(edge: _Edge, other: _Edge) -> bool:
    """Say whether two edges, whose bounding boxes touch, have a point in common."""
    sides = [_side(*edge, end) for end in other]
    other_sides = [_side(*other, end) for end in edge]
    return sides[0] * sides[1] <= 0 and other_sides[0] * other_sides[1] <= 0


def _side(a: Corner, b: Corner, c: Corner) -> int:
    """1 if c is to the left of the line from a to b, -1 to its right, 0 on it."""
    (ax, ay), (bx, by), (cx, cy) = (tuple(map(Fraction, each)) for each in (a, b, c))
    turn = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (turn > 0) - (turn < 0)
