"""Leaves that compare one number with different constants, as in the rules of large files. If the
number can lie beyond one threshold, it can lie beyond all lesser thresholds.

So the solver gets queries about the outermost thresholds of each kind of leaf. It gets queries
about the next thresholds only if it does not find the outer thresholds possible.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from rossmarie.ir import Compare, Comparison, Constant, Machine, Quantified, Quantifier

_ABOVE = (Comparison.GREATER, Comparison.GREATER_OR_EQUAL)
_BELOW = (Comparison.LESS, Comparison.LESS_OR_EQUAL)

Kind = tuple[Quantifier | None, Comparison, int]
"""The quantifier of a leaf, its comparison, and the number that it compares, by index."""


@dataclass(frozen=True)
class Threshold:
    """A leaf `number > value` or similar, also over elements."""

    proposition: int
    kind: Kind
    value: float

    @property
    def is_above(self) -> bool:
        """Say whether greater numbers make the leaf true."""
        return self.kind[1] in _ABOVE


IsPossible = Callable[[int, bool], bool]
"""A function that returns True if the solver finds that a proposition can be true, or false."""


def varied(machine: Machine, propositions: Iterable[int], is_possible: IsPossible) -> set[int]:
    """The propositions that are such leaves and can be true as well as false."""
    kinds: dict[Kind, list[Threshold]] = {}
    for proposition in propositions:
        threshold = _threshold(machine, proposition)
        if threshold is not None:
            kinds.setdefault(threshold.kind, []).append(threshold)
    found: set[int] = set()
    for alike in kinds.values():
        if len(alike) > 1:
            hardest_last = sorted(alike, key=lambda each: each.value, reverse=not alike[0].is_above)
            can_be_true = _possible(hardest_last[::-1], is_possible, value=True)
            # A leaf that is easier to make true is harder to make false.
            found |= can_be_true & _possible(hardest_last, is_possible, value=False)
    return found


def _possible(hardest_first: Sequence[Threshold], ask: IsPossible, *, value: bool) -> set[int]:
    for place, threshold in enumerate(hardest_first):
        if ask(threshold.proposition, value):
            return {each.proposition for each in hardest_first[place:]}
    return set()


def _threshold(machine: Machine, proposition: int) -> Threshold | None:
    node = machine.propositions[proposition].node
    quantifier = None
    if isinstance(node, Quantified):
        quantifier, node = node.quantifier, machine.propositions[node.element].node
    if not isinstance(node, Compare):
        return None
    left, right = machine.signals[node.left].node, machine.signals[node.right].node
    comparison, number, constant = node.comparison, node.left, right
    if isinstance(left, Constant):
        comparison, number, constant = comparison.mirrored, node.right, left
    if comparison not in _ABOVE + _BELOW or not isinstance(constant, Constant):
        return None
    return Threshold(proposition, (quantifier, comparison, number), constant.value)
