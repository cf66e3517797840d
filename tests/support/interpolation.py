"""Polynomials that interpolate functions, in exact numbers: where coefficients come from."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from support import exact_angles


def chebyshev_nodes(count: int, limit: Fraction) -> list[Fraction]:
    """The places from 0 to `limit` at which interpolation is best."""
    found = []
    for k in range(count):
        place = exact_angles.cosine(exact_angles.HALF_TURN * (2 * k + 1) // (2 * count))
        found.append(limit * (1 + Fraction(place, exact_angles.ONE)) / 2)
    return found


def rounded(x: Fraction) -> Fraction:
    """A number to some hundred bits."""
    return Fraction(exact_angles.fixed(x), exact_angles.ONE)


def interpolated(nodes: Sequence[Fraction], values: Sequence[Fraction]) -> list[Fraction]:
    """The terms of the polynomial that has these values there, by divided differences."""
    slopes = list(values)
    for order in range(1, len(nodes)):
        for k in range(len(nodes) - 1, order - 1, -1):
            slopes[k] = rounded((slopes[k] - slopes[k - 1]) / (nodes[k] - nodes[k - order]))
    terms: list[Fraction] = []
    for node, slope in zip(reversed(nodes), reversed(slopes), strict=True):
        shifted = [Fraction(0), *terms]
        for power, term in enumerate(terms):
            shifted[power] -= node * term
        shifted[0] += slope
        terms = shifted
    return terms
