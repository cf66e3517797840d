"""Terms of z3: numbers, comparisons, and what terms are made of."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import z3

from rossmarie.ir import Comparison


def rational(value: float) -> Any:
    """A double as the exact number that it is."""
    fraction = Fraction(value)
    return z3.Q(fraction.numerator, fraction.denominator)


def fraction(value: Any) -> Fraction:
    """The number that a model gives, or one very near it."""
    if z3.is_algebraic_value(value):
        value = value.approx(20)
    return Fraction(value.numerator_as_long(), value.denominator_as_long())


def compared(comparison: Comparison, left: Any, right: Any) -> Any:
    """A comparison of two terms."""
    match comparison:
        case Comparison.EQUAL:
            return left == right
        case Comparison.NOT_EQUAL:
            return left != right
        case Comparison.LESS:
            return left < right
        case Comparison.LESS_OR_EQUAL:
            return left <= right
        case Comparison.GREATER:
            return left > right
        case Comparison.GREATER_OR_EQUAL:
            return left >= right


def extreme(values: list[Any], *, least: bool) -> Any:
    """The least, or the greatest, of some terms."""
    found = values[0]
    for value in values[1:]:
        found = z3.If(value < found if least else value > found, value, found)
    return found


def leaves(term: Any) -> Iterator[Any]:
    """The variables and constants that a term is made of."""
    waiting = [term]
    while waiting:
        each = waiting.pop()
        if each.num_args() == 0:
            yield each
        waiting.extend(each.children())
