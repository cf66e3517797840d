"""Sine and cosine: how near they are to the exact ones, and what one expects of them."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rossmarie.core import Function, sines
from rossmarie.interpreter import arithmetic
from support import exact_angles
from support.depth import is_deep
from support.exact_angles import HALF_TURN, ONE
from support.interpolation import chebyshev_nodes, interpolated, rounded

BOUND, FAR_BOUND = 0.8, 1.5
"""In units of the last place up to a thousand radians and beyond, as S69 says."""

POINTS = 10_000 if is_deep() else 500
"""The number of compared values of each kind."""


def sine(angle: float) -> float:
    return arithmetic.apply(Function.SINE, (angle,))


def cosine(angle: float) -> float:
    return arithmetic.apply(Function.COSINE, (angle,))


def error(angle: float) -> float:
    """The greater of the errors of both, in units of the last place."""
    exact = exact_angles.within_a_turn(angle)
    return max(
        exact_angles.units(sine(angle), exact_angles.sine(exact)),
        exact_angles.units(cosine(angle), exact_angles.cosine(exact)),
    )


def angles(chance: random.Random, most: float) -> Iterator[float]:
    """Angles up to `most`: anywhere, in all binades near 0, and near whole right angles."""
    for _ in range(POINTS):
        yield chance.uniform(-most, most)
        yield chance.uniform(-8.0, 8.0)
        yield math.ldexp(chance.uniform(0.5, 1.0), -chance.randrange(60))
        yield near_right_angles(chance, most)


def near_right_angles(chance: random.Random, most: float) -> float:
    angle = chance.randint(1, int(most / 1.6)) * (math.pi / 2)
    for _ in range(chance.randrange(4)):
        angle = math.nextafter(angle, chance.choice([0.0, math.inf]))
    return angle


@pytest.mark.parametrize(("most", "bound"), [(1e3, BOUND), (sines.LARGEST, FAR_BOUND)])
def test_s69_both_are_near_the_exact_ones(most: float, bound: float) -> None:
    assert 0.5 < max(map(error, angles(random.Random(1), most))) < bound


@pytest.mark.parametrize(
    ("angle", "expected_sine", "expected_cosine"),
    [
        (0.0, 0.0, 1.0),
        (math.pi / 2, 1.0, 6.123233995736766e-17),
        (math.pi, 1.2246467991473532e-16, -1.0),
        (-math.pi / 2, -1.0, 6.123233995736766e-17),
        (3 * math.pi / 2, -1.0, -1.8369701987210297e-16),
        (5e-324, 5e-324, 1.0),
    ],
)
def test_numbers_that_everybody_knows(
    angle: float, expected_sine: float, expected_cosine: float
) -> None:
    assert (sine(angle), cosine(angle)) == (expected_sine, expected_cosine)


@pytest.mark.parametrize("angle", [sines.LARGEST, -1e7, math.inf, -math.inf, math.nan])
def test_s69_of_an_angle_that_is_too_large_both_are_unknown(angle: float) -> None:
    assert math.isnan(sine(angle))
    assert math.isnan(cosine(angle))


@given(st.floats(-1e6, 1e6))
def test_the_sine_is_odd_and_the_cosine_even(angle: float) -> None:
    assert math.isnan(sine(angle)) or sine(-angle) == -sine(angle)
    assert math.isnan(cosine(angle)) or cosine(-angle) == cosine(angle)


@given(st.floats(-1e5, 1e5))
def test_squares_add_up_to_one(angle: float) -> None:
    assert math.hypot(sine(angle), cosine(angle)) == pytest.approx(1.0, rel=4e-16)


# --- where the numbers come from -------------------------------------------------------------


def test_a_right_angle_is_three_numbers() -> None:
    right_angle = Fraction(HALF_TURN, 2 * ONE)
    first = cut(right_angle)
    second = cut(right_angle - first)
    third = float(right_angle - first - second)
    assert (float(first), float(second), third) == (sines.FIRST, sines.SECOND, sines.THIRD)
    assert float(1 / right_angle) == sines.RIGHT_ANGLES


def cut(number: Fraction, bits: int = 33) -> Fraction:
    """A number without all bits but the first."""
    last = Fraction(2) ** (math.frexp(float(number))[1] - bits)
    return number // last * last


def of_sine(z: Fraction) -> Fraction:
    x = root(z)
    return (Fraction(exact_angles.sine(exact_angles.fixed(x)), ONE) / x - 1) / z


def of_cosine(z: Fraction) -> Fraction:
    found = Fraction(exact_angles.cosine(exact_angles.fixed(root(z))), ONE)
    return (found - 1 + z / 2) / (z * z)


def root(z: Fraction) -> Fraction:
    return Fraction(math.isqrt(exact_angles.fixed(z) * ONE), ONE)


@pytest.mark.parametrize(
    ("terms", "function"), [(sines.SINE_TERMS, of_sine), (sines.COSINE_TERMS, of_cosine)]
)
def test_terms_interpolate_at_chebyshev_nodes(
    terms: Sequence[float], function: Callable[[Fraction], Fraction]
) -> None:
    nodes = chebyshev_nodes(len(terms), Fraction(math.pi / 4) ** 2)
    values = [rounded(function(node)) for node in nodes]
    assert tuple(map(float, interpolated(nodes, values))) == terms
