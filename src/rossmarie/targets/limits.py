"""Comparisons with fixed limits as places on the number line at which their values change.

The input is a leaf proposition; the result is its limits, or None if it has no fixed limits. A
limit `at` separates the numbers `x <= at` from greater numbers. So the limit of `x >= c` is the
next double below `c`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.ir import Comparison


@dataclass(frozen=True)
class PropositionLimit:
    """A limit. Above `at`, the proposition is true if it `rises`, else false; below, it has the
    opposite value.
    """

    at: float
    rises: bool
    leaf: int = -1


@dataclass(frozen=True)
class Limited:
    """The limits of a proposition on one signal, from low to high."""

    signal: int
    limits: list[PropositionLimit]


def limits_of(machine: ir.Machine, node: ir.PropositionNode) -> Limited | None:
    """The limits of a comparison of one signal with constants."""
    match node:
        case ir.Compare(comparison=comparison, left=left, right=right):
            low, high = _constant(machine, left), _constant(machine, right)
            if low is None and high is not None:
                return Limited(left, _compared(comparison, high))
            if low is not None and high is None:
                return Limited(right, _compared(comparison.mirrored, low))
        case ir.Between(signal=signal, low=low_signal, high=high_signal):
            low, high = _constant(machine, low_signal), _constant(machine, high_signal)
            if low is not None and high is not None and _constant(machine, signal) is None:
                return Limited(signal, _between(low, high))
        case ir.Flag(signal=signal) if _constant(machine, signal) is None:
            return Limited(signal, _flag(machine, signal))
        case (
            ir.Literal() | ir.Flag() | ir.AgeReaches() | ir.Oscillates() | ir.Quantified()
            | ir.Not() | ir.And() | ir.Or() | ir.Held() | ir.Since() | ir.Recurs()
        ):  # fmt: skip
            pass
    return None


def true_below(limits: list[PropositionLimit]) -> set[int]:
    """The propositions that are true below all their limits, which are sorted from low to high. A
    proposition without limits is never true.
    """
    lowest: dict[int, PropositionLimit] = {}
    for limit in limits:
        lowest.setdefault(limit.leaf, limit)
    return {leaf for leaf, limit in lowest.items() if not limit.rises}


def twins(limits: list[PropositionLimit]) -> list[int | None]:
    """For each limit, the index of the other limit of the same proposition; None if there is no
    other.
    """
    places: dict[int, list[int]] = {}
    for place, limit in enumerate(limits):
        places.setdefault(limit.leaf, []).append(place)
    return [
        next((other for other in places[limit.leaf] if other != place), None)
        for place, limit in enumerate(limits)
    ]


def _constant(machine: ir.Machine, signal: int) -> float | None:
    node = machine.signals[signal].node
    return node.value if isinstance(node, ir.Constant) else None


def _below(value: float) -> float:
    return math.nextafter(value, -math.inf)


def _compared(comparison: Comparison, value: float) -> list[PropositionLimit]:
    match comparison:
        case Comparison.GREATER:
            return [PropositionLimit(value, True)]
        case Comparison.GREATER_OR_EQUAL:
            return [PropositionLimit(_below(value), True)]
        case Comparison.LESS:
            return [PropositionLimit(_below(value), False)]
        case Comparison.LESS_OR_EQUAL:
            return [PropositionLimit(value, False)]
        case Comparison.EQUAL:
            return [PropositionLimit(_below(value), True), PropositionLimit(value, False)]
        case Comparison.NOT_EQUAL:
            return [PropositionLimit(_below(value), False), PropositionLimit(value, True)]


def _between(low: float, high: float) -> list[PropositionLimit]:
    return (
        [PropositionLimit(_below(low), True), PropositionLimit(high, False)] if low <= high else []
    )


def _flag(machine: ir.Machine, signal: int) -> list[PropositionLimit]:
    """The limits of a flag. It is 0 or 1; any other number counts as true unless it is 0."""
    if ir.kind_of(machine, signal) is ir.FieldKind.FLAG:
        return [PropositionLimit(0.5, True)]
    return _compared(Comparison.NOT_EQUAL, 0.0)
