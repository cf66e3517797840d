"""Arc sine and arc tangent: how near they are to the exact angles, and what one expects of them."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rossmarie.core import Function, angles
from rossmarie.interpreter import arithmetic
from support import exact_angles
from support.depth import is_deep
from support.interpolation import chebyshev_nodes, interpolated, rounded

SINE_BOUND, TANGENT_BOUND = 0.75, 0.85
"""In units of the last place, as `docs/explanation/semantics.md` says in S5."""

POINTS = 20_000 if is_deep() else 1_000
"""The number of compared values of each kind."""

PI = math.pi
FINITE = st.floats(allow_nan=False, allow_infinity=False)
SINES = st.floats(-1.0, 1.0)


def arc_sine(x: float) -> float:
    return arithmetic.program(angles.ARC_SINE)([x])


def arc_tangent(y: float, x: float) -> float:
    return arithmetic.program(angles.ARC_TANGENT)([y, x])


# --- how near --------------------------------------------------------------------------------


def sines(chance: random.Random) -> Iterator[float]:
    """Numbers from 0 to 1: anywhere, in all binades near 0, near 1, near 1/2."""
    for _ in range(POINTS):
        yield chance.random()
        yield math.ldexp(chance.uniform(0.5, 1.0), -chance.randrange(60))
        yield 1.0 - math.ldexp(chance.uniform(0.5, 1.0), -chance.randrange(54))
        yield chance.uniform(0.48, 0.52)


def points(chance: random.Random) -> Iterator[tuple[float, float]]:
    """Points in all octants: anywhere, near axes, near diagonals, near where formulas change."""
    ratios = (angles.NEAR_TANGENT, angles.MIDDLE_TANGENT, 1.0)
    for _ in range(POINTS):
        x = chance.uniform(0.5, 1.0)
        yield from octants(x, x * chance.random())
        yield from octants(x, math.ldexp(chance.uniform(0.5, 1.0), -chance.randrange(100)))
        yield from octants(x, x * chance.choice(ratios) * chance.uniform(0.97, 1.03))


def octants(x: float, y: float) -> Iterator[tuple[float, float]]:
    """Four points that lie alike above the axis; those below have the same digits."""
    yield from ((y, x), (x, y), (x, -y), (y, -x))


def test_the_arc_sine_is_nearer_than_one_unit() -> None:
    worst = max(
        exact_angles.units(arc_sine(x), exact_angles.arc_sine(x)) for x in sines(random.Random(1))
    )
    assert 0.5 < worst < SINE_BOUND


def test_the_arc_tangent_is_nearer_than_one_unit() -> None:
    worst = max(
        exact_angles.units(arc_tangent(y, x), exact_angles.angle(y, x))
        for y, x in points(random.Random(2))
    )
    assert 0.5 < worst < TANGENT_BOUND


@given(st.floats(-(2.0**-27), 2.0**-27))
@example(5e-324)
def test_of_a_small_number_both_are_that_number(x: float) -> None:
    assert exactly(arc_sine(x)) == exactly(arc_tangent(x, 1.0)) == exactly(x)


EXTREME = st.floats(-(2.0**511), 2.0**511) | st.floats(-(2.0**-530), 2.0**-530)


@pytest.mark.parametrize("function", [Function.ROLL, Function.YAW])
@given(orientation=st.tuples(EXTREME, EXTREME, EXTREME, EXTREME))
def test_the_points_of_orientations_are_no_exception(
    function: Function, orientation: tuple[float, float, float, float]
) -> None:
    """Nothing that S5 applies the arc tangent to is too small or too large for its bound."""
    x, y, z, w = orientation
    n = ((x * x + y * y) + z * z) + w * w
    if function is Function.ROLL:
        one, other = w * x + y * z, x * x + y * y
    else:
        one, other = w * z + x * y, y * y + z * z
    if n == 0.0:
        return
    sine, cosine = 2.0 * one / n, 1.0 - 2.0 * other / n
    # The exact angle has digits for a hundred zeros behind the point.
    if all(map(math.isfinite, (sine, cosine))) and abs(sine) > 1e-100:
        found, exact = arithmetic.apply(function, orientation), exact_angles.angle(sine, cosine)
        assert exact_angles.units(found, exact) < TANGENT_BOUND


# --- what one expects ------------------------------------------------------------------------


def exactly(x: float) -> str:
    """A number with the sign of a zero."""
    return x.hex()


@pytest.mark.parametrize(
    ("x", "expected"),
    [(0.0, 0.0), (-0.0, -0.0), (1.0, PI / 2), (-1.0, -PI / 2), (0.5, 0.5235987755982989)],
)
def test_arc_sines_that_everybody_knows(x: float, expected: float) -> None:
    assert exactly(arc_sine(x)) == exactly(expected)


@pytest.mark.parametrize(
    ("y", "x", "expected"),
    [
        (0.0, 1.0, 0.0),
        (1.0, 1.0, PI / 4),
        (1.0, 0.0, PI / 2),
        (1.0, -0.0, PI / 2),
        (1.0, -1.0, 3 * PI / 4),
        (0.0, -1.0, PI),
        (0.0, 0.0, 0.0),
        (1.0, math.inf, 0.0),
        (math.inf, -1.0, PI / 2),
        (1.0, -math.inf, PI),
        (5e-324, -1.0, PI),
    ],
)
def test_angles_that_everybody_knows(y: float, x: float, expected: float) -> None:
    assert exactly(arc_tangent(y, x)) == exactly(expected)
    assert exactly(arc_tangent(-y, x)) == exactly(-expected)


@pytest.mark.parametrize("x", [math.nan, math.inf, -math.inf, math.nextafter(1.0, 2.0), -2.0])
def test_beyond_one_there_is_no_arc_sine(x: float) -> None:
    assert math.isnan(arc_sine(x))


@pytest.mark.parametrize("other", [0.0, -0.0, 1.0, -2.0, 5e-324, math.inf, math.nan])
def test_of_what_is_unknown_there_is_no_angle(other: float) -> None:
    assert math.isnan(arc_tangent(math.nan, other))
    assert math.isnan(arc_tangent(other, math.nan))


def test_of_two_infinite_numbers_there_is_no_angle() -> None:
    assert math.isnan(arc_tangent(math.inf, -math.inf))


@given(SINES)
def test_the_arc_sine_is_odd(x: float) -> None:
    assert exactly(arc_sine(-x)) == exactly(-arc_sine(x))


@given(FINITE, FINITE)
def test_the_angle_below_is_the_one_above(y: float, x: float) -> None:
    found = arc_tangent(y, x)
    assert math.isnan(found) or exactly(arc_tangent(-y, x)) == exactly(-found)


@given(SINES, FINITE, FINITE)
def test_no_angle_is_out_of_range(sine: float, y: float, x: float) -> None:
    assert abs(arc_sine(sine)) <= PI / 2
    found = arc_tangent(y, x)
    assert math.isnan(found) or abs(found) <= PI


def neighbors(x: float, count: int = 300) -> Iterator[float]:
    """Numbers that follow each other, half of them before this one."""
    for _ in range(count // 2):
        x = math.nextafter(x, 0.0)
    for _ in range(count):
        yield x
        x = math.nextafter(x, math.inf)


def rises(values: Sequence[float]) -> bool:
    return all(one <= other for one, other in pairwise(values))


def beginnings(known: Sequence[float]) -> list[float]:
    chance = random.Random(3)
    return [*known, *(chance.random() for _ in range(POINTS // 20))]


@pytest.mark.parametrize("x", beginnings([angles.NEAR_SINE, 2.0**-27, math.sin(1.0)]))
def test_the_arc_sine_rises(x: float) -> None:
    assert rises([arc_sine(each) for each in neighbors(x)])


@pytest.mark.parametrize(
    "tangent", beginnings([angles.NEAR_TANGENT, angles.MIDDLE_TANGENT, 1.0, 2.0**-27])
)
def test_the_arc_tangent_rises(tangent: float) -> None:
    for x in (1.0, 0.7):
        heights = list(neighbors(tangent * x))
        assert rises([arc_tangent(y, x) for y in heights])
        assert rises([arc_tangent(-x, y) for y in heights])
        assert rises([-arc_tangent(y, -x) for y in heights])


# --- where the numbers come from -------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "whole"),
    [
        ("HALF_TURN", exact_angles.HALF_TURN),
        ("RIGHT_ANGLE", exact_angles.HALF_TURN // 2),
        ("DIAGONAL", exact_angles.HALF_TURN // 4),
        ("OF_A_HALF", exact_angles.angle(1.0, 2.0)),
    ],
)
def test_known_angles_are_two_numbers(name: str, whole: int) -> None:
    upper = whole / exact_angles.ONE
    lower = float(Fraction(whole, exact_angles.ONE) - Fraction(upper))
    assert getattr(angles, name) == upper
    assert getattr(angles, f"{name}_REST") == lower


@pytest.mark.parametrize(
    ("terms", "function", "most"),
    [
        (angles.SINE_TERMS, exact_angles.arc_sine, angles.NEAR_SINE),
        (angles.TANGENT_TERMS, lambda x: exact_angles.angle(x, 1.0), angles.NEAR_TANGENT),
    ],
)
def test_terms_interpolate_at_chebyshev_nodes(
    terms: Sequence[float], function: Callable[[Fraction], int], most: float
) -> None:
    count, limit = len(terms), Fraction(most) ** 2
    nodes = chebyshev_nodes(count, limit)
    values = [surplus(function, node) for node in nodes]
    assert tuple(map(float, interpolated(nodes, values))) == terms


def surplus(function: Callable[[Fraction], int], z: Fraction) -> Fraction:
    """The function that the polynomial approximates: `(f(x) / x - 1) / z` in `z = x * x`."""
    x = Fraction(math.isqrt(exact_angles.fixed(z) * exact_angles.ONE), exact_angles.ONE)
    return rounded((Fraction(function(x), exact_angles.ONE) / x - 1) / z)
