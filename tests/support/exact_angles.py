"""Angles, sines and cosines to some hundred bits, in whole numbers, to compare angles with."""

from __future__ import annotations

import math
from fractions import Fraction
from math import isqrt

ONE = 1 << 400
"""The whole number that stands for 1."""


def fixed(number: float | Fraction) -> int:
    """The whole number that stands for a number, rounded down."""
    exact = Fraction(number)
    return exact.numerator * ONE // exact.denominator


def _small_arc_tangent(x: int) -> int:
    """The series, of a number near zero."""
    square = x * x // ONE
    total, power, divisor = x, x, 1
    while power:
        power = abs(power) * square // ONE * (-1 if power > 0 else 1)
        divisor += 2
        total += abs(power) // divisor * (1 if power > 0 else -1)
    return total


def _arc_tangent(x: int) -> int:
    """The arc tangent of a number from 0 to 1, by halving the angle repeatedly."""
    halvings = 0
    while x > ONE >> 8:
        x = x * ONE // (ONE + isqrt(ONE * ONE + x * x))
        halvings += 1
    return _small_arc_tangent(x) << halvings


HALF_TURN = 4 * _arc_tangent(ONE)


def angle(y: float, x: float) -> int:
    """The angle of a point in the plane that is not the origin."""
    height, width = abs(Fraction(y)), abs(Fraction(x))
    if width < height:
        octant = HALF_TURN // 2 - _arc_tangent(fixed(width / height))
    else:
        octant = _arc_tangent(fixed(height / width))
    quadrant = HALF_TURN - octant if x < 0 else octant
    return -quadrant if y < 0 else quadrant


def arc_sine(x: float) -> int:
    """The angle with this sine, not nearer to zero than 1e-100."""
    sine = fixed(abs(x))
    cosine = isqrt(ONE * ONE - sine * sine)
    lesser, greater = sorted((sine, cosine))
    octant = _arc_tangent(lesser * ONE // greater)
    quadrant = octant if sine < cosine else HALF_TURN // 2 - octant
    return -quadrant if x < 0 else quadrant


def units(found: float, exact: int) -> float:
    """The distance of a result from the exact result, in units of its last place."""
    nearest = exact / ONE
    return abs(float((Fraction(found) - Fraction(exact, ONE)) / Fraction(math.ulp(nearest))))


def cosine(angle: int) -> int:
    """The cosine of an angle."""
    return _wave(ONE, angle, 0)


def sine(angle: int) -> int:
    """The sine of an angle."""
    return _wave(angle, angle, 1)


def _wave(term: int, angle: int, count: int) -> int:
    total, square = 0, angle * angle // ONE
    while term:
        total += term
        count += 2
        size = abs(term) * square // ONE // (count * (count - 1))
        term = -size if term > 0 else size
    return total


def within_a_turn(angle: float) -> int:
    """The same angle, between a half turn to either side."""
    return (fixed(angle) + HALF_TURN) % (2 * HALF_TURN) - HALF_TURN
