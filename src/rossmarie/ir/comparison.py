"""Propositions about numbers (rules S27 to S29). A NaN operand makes them unknown. Infinities,
which occur only in elements of arrays, are ordinary numbers here.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from typing import Any

from rossmarie.ir.kleene import proposition_of
from rossmarie.ir.signs import Comparison
from rossmarie.ir.verdict import TruthValue

COMPARISONS: Mapping[Comparison, Callable[[Any, Any], Any]] = {
    Comparison.EQUAL: operator.eq,
    Comparison.NOT_EQUAL: operator.ne,
    Comparison.LESS: operator.lt,
    Comparison.LESS_OR_EQUAL: operator.le,
    Comparison.GREATER: operator.gt,
    Comparison.GREATER_OR_EQUAL: operator.ge,
}
"""The comparisons of two numbers, or of columns of numbers."""


def compare(comparison: Comparison, left: float, right: float) -> TruthValue:
    """`left OP right` (S27)."""
    if math.isnan(left) or math.isnan(right):
        return TruthValue.UNKNOWN
    return proposition_of(bool(COMPARISONS[comparison](left, right)))


def is_between(value: float, low: float, high: float) -> TruthValue:
    """`value in [low, high]` (S28)."""
    if math.isnan(value) or math.isnan(low) or math.isnan(high):
        return TruthValue.UNKNOWN
    return proposition_of(low <= value <= high)


def is_set(value: float) -> TruthValue:
    """A flag, which is false if it is 0.0, and true otherwise (S29)."""
    return TruthValue.UNKNOWN if math.isnan(value) else proposition_of(value != 0.0)
