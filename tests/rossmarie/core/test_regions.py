"""Functions of regions: against Shapely, and at edges, where definitions differ (S63, S64, S81)."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from rossmarie.core import (
    Circle,
    Polygon,
    Rectangle,
    Region,
    RegionFunction,
    RegionMeasure,
    Shape,
    defined,
    row,
)
from rossmarie.core.expressions import Operand, applied_in
from rossmarie.core.regions import define
from rossmarie.interpreter.arithmetic import apply, program
from support.exact_expressions import holds, value

MAP = 3.0
"""The number of the text `map`, say."""

Corners = tuple[tuple[float, float], ...]


def function(measure: RegionMeasure, *polygons: Corners) -> RegionFunction:
    named = (Polygon(f"p_{n}", f"polygon {n}", each) for n, each in enumerate(polygons))
    return RegionFunction(measure, Region("r", "the region", tuple(named)))


def inside(x: float, y: float, *polygons: Corners) -> float:
    return apply(function(RegionMeasure.INSIDE, *polygons), (x, y, MAP, MAP))


def distance(x: float, y: float, *polygons: Corners) -> float:
    return apply(function(RegionMeasure.DISTANCE, *polygons), (x, y, MAP, MAP))


SQUARE = ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0))
BESIDE = ((2.0, 0.0), (4.0, 0.0), (4.0, 2.0), (2.0, 2.0))
ABOVE = ((0.0, 2.0), (2.0, 2.0), (2.0, 4.0), (0.0, 4.0))


@st.composite
def stars(draw: st.DrawFn) -> Corners:
    """Polygons around a point: as many corners as one likes, never crossing themselves."""
    count = draw(st.integers(3, 80))
    radii = draw(st.lists(st.floats(0.5, 20), min_size=count, max_size=count))
    x, y = draw(st.tuples(st.floats(-30, 30), st.floats(-30, 30)))
    turns = [2 * math.pi * number / count for number in range(count)]
    return tuple(
        (x + radius * math.cos(turn), y + radius * math.sin(turn))
        for radius, turn in zip(radii, turns, strict=True)
    )


PLACES = st.floats(-30, 30)


@st.composite
def boxes(draw: st.DrawFn) -> Rectangle:
    low = draw(st.tuples(PLACES, PLACES))
    sides = draw(st.tuples(st.floats(0.01, 20), st.floats(0.01, 20)))
    return Rectangle("b", "a box", low, (low[0] + sides[0], low[1] + sides[1]))


circles = st.builds(
    Circle, st.just("c"), st.just("a circle"), st.tuples(PLACES, PLACES), st.floats(0.01, 20)
)


def zone(measure: RegionMeasure, *shapes: Shape) -> RegionFunction:
    named = (replace(each, name=f"s_{number}") for number, each in enumerate(shapes))
    return RegionFunction(measure, Region("z", "the zone", tuple(named)))


zones = st.lists(st.one_of(boxes(), circles), min_size=1, max_size=4)


def gap_from(shape: Rectangle | Circle, x: float, y: float) -> float:
    """The distance from a shape, negative inside of it."""
    if isinstance(shape, Circle):
        return shapely.Point(shape.centre).distance(shapely.Point(x, y)) - shape.radius
    box = shapely.box(*shape.low, *shape.high)
    point = shapely.Point(x, y)
    return -box.boundary.distance(point) if box.contains(point) else box.distance(point)


points = st.tuples(st.floats(-60, 60), st.floats(-60, 60))


@given(st.lists(stars(), min_size=1, max_size=4), points)
def test_inside_is_that_of_shapely(polygons: list[Corners], point: tuple[float, float]) -> None:
    shapes = [shapely.Polygon(each) for each in polygons]
    assume(all(each.boundary.distance(shapely.Point(point)) > 1e-9 for each in shapes))
    wanted = any(each.contains(shapely.Point(point)) for each in shapes)
    assert inside(*point, *polygons) == wanted


@given(st.lists(stars(), min_size=1, max_size=4), points)
def test_distance_is_that_of_shapely(polygons: list[Corners], point: tuple[float, float]) -> None:
    wanted = min(shapely.Polygon(each).distance(shapely.Point(point)) for each in polygons)
    assert distance(*point, *polygons) == pytest.approx(wanted, abs=1e-9)


@given(zones, points)
def test_boxes_and_circles_are_those_of_shapely(
    shapes: list[Rectangle | Circle], point: tuple[float, float]
) -> None:
    gap = min(gap_from(each, *point) for each in shapes)
    assume(all(abs(gap_from(each, *point)) > 1e-9 for each in shapes))
    operands = (*point, MAP, MAP)
    assert apply(zone(RegionMeasure.INSIDE, *shapes), operands) == (gap < 0)
    assert apply(zone(RegionMeasure.DISTANCE, *shapes), operands) == pytest.approx(
        max(gap, 0), abs=1e-9
    )


def test_the_edges_of_boxes_and_circles_are_in_them() -> None:
    square = Rectangle("b", "a box", (-1.0, -2.0), (1.0, 2.0))
    for x, y in (*square.corners, (0.0, 2.0), (1.0, 0.0)):
        assert apply(zone(RegionMeasure.INSIDE, square), (x, y, MAP, MAP)) == 1.0
        assert apply(zone(RegionMeasure.DISTANCE, square), (x, y, MAP, MAP)) == 0.0
    circle = Circle("c", "a circle", (0.0, 0.0), 5.0)
    for x, y in (*circle.corners, (3.0, 4.0), (-4.0, 3.0)):
        assert apply(zone(RegionMeasure.INSIDE, circle), (x, y, MAP, MAP)) == 1.0
        assert apply(zone(RegionMeasure.DISTANCE, circle), (x, y, MAP, MAP)) == 0.0


@given(zones, points)
def test_bounds_of_boxes_and_circles_hold_in_real_numbers(
    shapes: list[Rectangle | Circle], point: tuple[float, float]
) -> None:
    of_zone = zone(RegionMeasure.DISTANCE, *shapes)
    bounds, operands = row(of_zone).bounds, (*point, MAP, MAP)
    assert bounds is not None
    numbers = [*map(Fraction, operands), Fraction(apply(of_zone, operands))]
    written = [Operand(index) for index in range(len(numbers))]
    assert all(holds(bound, numbers) for bound in bounds(written[-1], written[:-1]))


@given(zones, st.floats(0, 50), st.floats(0, 1))
def test_a_distance_is_easy_beyond_the_outermost_point(
    shapes: list[Rectangle | Circle], beyond: float, share: float
) -> None:
    of_zone = zone(RegionMeasure.DISTANCE, *shapes)
    easy = row(of_zone).easy
    assert easy is not None
    outermost = max(shapes, key=lambda each: max(each.corners))
    x, y = max(outermost.corners)
    if isinstance(outermost, Rectangle):
        y = max(outermost.low[1], y - share * (y - outermost.low[1]))
    operands = (x + beyond, y, MAP, MAP)
    numbers = [*map(Fraction, operands)]
    cases = easy(tuple(map(Operand, range(4))))
    (case,) = (each for each in cases if all(holds(one, numbers) for one in each.conditions))
    found = float(value(case.value, numbers))
    assert apply(of_zone, operands) == pytest.approx(found, abs=1e-9)


@given(st.sampled_from([0.0, 0.5, 1.0, 2.0, 3.0, 4.0]), st.sampled_from([0.0, 1.0, 2.0, 3.0, 4.0]))
def test_a_point_on_an_edge_is_in_one_of_the_polygons_beside_it(x: float, y: float) -> None:
    found = [inside(x, y, each) for each in (SQUARE, BESIDE, ABOVE)]
    is_within = (x < 4 and y < 2) or (x < 2 and y < 4)
    assert sum(found) == is_within


@pytest.mark.parametrize("measure", RegionMeasure)
@pytest.mark.parametrize(
    "operands",
    [(math.nan, 1.0, MAP, MAP), (1.0, math.nan, MAP, MAP), (1.0, 1.0, MAP + 1, MAP),
     (1.0, 1.0, -1.0, MAP), (1.0, 1.0, math.nan, MAP)],
)  # fmt: skip
def test_a_point_of_another_frame_is_not_known(
    measure: RegionMeasure, operands: tuple[float, ...]
) -> None:
    assert math.isnan(apply(function(measure, SQUARE), operands))


def test_a_point_is_a_distance_and_nowhere_inside() -> None:
    assert distance(3.0, 4.0, ((0.0, 0.0),)) == 5.0
    assert inside(0.0, 0.0, ((0.0, 0.0),)) == 0.0
    assert distance(1.0, 5.0, SQUARE, ((1.0, 9.0),)) == 3.0


def test_a_distance_that_no_number_holds_is_not_known() -> None:
    assert math.isnan(distance(1e308, 0.0, SQUARE))
    assert inside(1e308, 0.0, SQUARE) == 0.0


def test_many_polygons_with_many_corners_are_one_region() -> None:
    turns = [2 * math.pi * number / 1000 for number in range(1000)]
    ring = tuple((10 * math.cos(turn), 10 * math.sin(turn)) for turn in turns)
    squares = [((n, 20.0), (n + 0.5, 20.0), (n + 0.5, 21.0), (n, 21.0)) for n in range(300)]
    assert inside(9.9, 0.1, ring, *squares) == 1.0
    assert inside(299.25, 20.5, ring, *squares) == 1.0
    assert inside(299.75, 20.5, ring, *squares) == 0.0
    assert distance(299.75, 20.5, ring, *squares) == pytest.approx(0.25)
    assert distance(0.0, 15.0, ring, *squares) == pytest.approx(5.0, abs=1e-3)


# --- what solvers may know ---------------------------------------------------------------------


@given(st.sampled_from(RegionMeasure), st.lists(stars(), min_size=1, max_size=3), points)
def test_bounds_hold_in_real_numbers(
    measure: RegionMeasure, polygons: list[Corners], point: tuple[float, float]
) -> None:
    of_region = function(measure, *polygons)
    bounds, operands = row(of_region).bounds, (*point, MAP, MAP)
    numbers = [*map(Fraction, operands), Fraction(apply(of_region, operands))]
    written = [Operand(index) for index in range(len(numbers))]
    for bound in () if bounds is None else bounds(written[-1], written[:-1]):
        assert holds(bound, numbers)


@given(st.lists(stars(), min_size=1, max_size=3), st.floats(0, 50))
def test_a_distance_is_easy_beyond_the_last_corner(polygons: list[Corners], beyond: float) -> None:
    of_region = function(RegionMeasure.DISTANCE, *polygons)
    easy = row(of_region).easy
    assert easy is not None
    x, y = max(corner for each in polygons for corner in each)
    operands = (x + beyond, y, MAP, MAP)
    numbers = [*map(Fraction, operands)]
    cases = easy(tuple(map(Operand, range(4))))
    (case,) = (each for each in cases if all(holds(one, numbers) for one in each.conditions))
    found = float(value(case.value, numbers))
    assert apply(of_region, operands) == pytest.approx(found, abs=1e-9)


def test_a_region_of_points_has_no_function_that_reads_no_operand() -> None:
    x, y, seen, wanted = map(Operand, range(4))
    asked = define(function(RegionMeasure.INSIDE, ((1.0, 1.0),)), (x, y, seen, wanted))
    assert "Subfunction" not in repr(asked)  # compilers warn of parameters that nobody reads
    assert inside(1.0, 1.0, ((1.0, 1.0),)) == 0.0


@pytest.mark.parametrize(
    "shape",
    [
        Circle("c", "a circle", (1.0, 2.0), 3.0),
        Rectangle("b", "a box", (0.0, 0.0), (2.0, 1.0)),
        Polygon("p", "a polygon", SQUARE),
        Polygon("q", "a point", ((1.0, 2.0),)),
    ],
    ids=lambda shape: shape.about,
)
@pytest.mark.parametrize("operands", [(math.nan, 0.5), (0.5, math.nan), (math.nan, math.nan)])
def test_every_part_of_a_distance_is_unknown_of_an_unknown_point(
    shape: Shape, operands: tuple[float, float]
) -> None:
    """Proofs replace these parts by functions whose result is unknown if an operand is unknown."""
    whole = RegionFunction(RegionMeasure.DISTANCE, Region("r", "the region", (shape,)))
    parts = applied_in(defined(whole, 4))
    assert parts
    for part in parts:
        assert math.isnan(program(part)(operands)), part.name
