"""The margins of conditions as signals: the distance of a condition from becoming true.

The input is lowered propositions. A margin is positive while its condition is false, and negative
while it is true. In signal temporal logic, this is the robustness of the requirement that the
condition stays false. Negation is pushed down to the comparisons, so that each margin is a
difference, or the least or greatest of other margins.
"""

from __future__ import annotations

import sys

from rossmarie import ir
from rossmarie.lowering.nodes import Nodes, Shown

_Key = tuple[int, bool]
"""A proposition, and True for its negation."""

_GREATEST = sys.float_info.max
_UPWARDS = (ir.Comparison.GREATER, ir.Comparison.GREATER_OR_EQUAL)
_DOWNWARDS = (ir.Comparison.LESS, ir.Comparison.LESS_OR_EQUAL)


class Margins:
    """Creates the signals of margins. Equal signals are shared."""

    def __init__(self, nodes: Nodes) -> None:
        self._nodes = nodes
        self._known: dict[_Key, int] = {}

    def of(self, proposition: int) -> int:
        """The signal of the margin of a condition. The checker has ensured that the condition has a
        margin.
        """
        for key in self._needed((proposition, False)):
            if key not in self._known:
                self._known[key] = self._made(*key)
        return self._known[proposition, False]

    def _needed(self, key: _Key) -> list[_Key]:
        """A proposition and all its operands. Operands come first, because they have lesser
        indices.
        """
        found: set[_Key] = set()
        waiting = [key]
        while waiting:
            each = waiting.pop()
            if each not in found:
                found.add(each)
                waiting += self._operands(*each)
        return sorted(found)

    def _operands(self, proposition: int, negated: bool) -> tuple[_Key, ...]:
        match self._nodes.propositions[proposition].node:
            case ir.Not(operand=operand):
                return ((operand, not negated),)
            case ir.And(operands=operands) | ir.Or(operands=operands):
                return tuple((operand, negated) for operand in operands)
            case ir.Quantified(element=element) if self._against_a_constant(element) is not None:
                return ()
            case ir.Held(operand=operand) | ir.Quantified(element=operand):
                return ((operand, negated),)
            case (
                ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches()
                | ir.Oscillates() | ir.Since() | ir.Recurs()
            ):  # fmt: skip
                return ()

    def _made(self, proposition: int, negated: bool) -> int:
        shown = self._shown(proposition, negated)
        below = [self._known[key] for key in self._operands(proposition, negated)]
        match self._nodes.propositions[proposition].node:
            case ir.Compare() as comparison:
                return self._of_comparison(comparison, negated, shown)
            case ir.Between(signal=signal, low=low, high=high):
                if negated:
                    inside = self._gap(signal, low, shown), self._gap(high, signal, shown)
                    return self._nodes.apply(ir.Function.MINIMUM, inside, shown)
                outside = self._gap(low, signal, shown), self._gap(signal, high, shown)
                return self._nodes.apply(ir.Function.MAXIMUM, outside, shown)
            case ir.Not() | ir.Held():
                return below[0]
            case ir.And():
                return self._extreme(below, is_least=negated, shown=shown)
            case ir.Or():
                return self._extreme(below, is_least=not negated, shown=shown)
            case ir.Quantified(quantifier=quantifier, element=element):
                is_least = (quantifier is ir.Quantifier.ANY) is not negated
                compared = self._against_a_constant(element)
                if compared is not None:
                    return self._of_extreme_element(compared, is_least, negated, shown)
                if (beside := self._against_a_number(element)) is not None:
                    return self._of_elements_in_reach(beside, is_least, negated, shown)
                return self._nodes.signal(ir.Fold(_folding(is_least), below[0]), shown)
            case (
                ir.Literal() | ir.Flag() | ir.AgeReaches() | ir.Oscillates() | ir.Since()
                | ir.Recurs()
            ) as node:  # fmt: skip
                raise AssertionError(f"checked: {type(node).__name__} has no distance")

    def _of_comparison(self, node: ir.Compare, negated: bool, shown: Shown) -> int:
        assert node.comparison in (*_UPWARDS, *_DOWNWARDS), "checked"
        if (node.comparison in _UPWARDS) is not negated:
            return self._gap(node.right, node.left, shown)
        return self._gap(node.left, node.right, shown)

    def _against_a_constant(self, proposition: int) -> ir.Compare | None:
        """The comparison of a number with a constant, if the proposition is such a comparison; else
        None.
        """
        node = self._nodes.propositions[proposition].node
        if isinstance(node, ir.Compare) and any(map(self._is_constant, (node.left, node.right))):
            return node
        return None

    def _of_extreme_element(
        self, node: ir.Compare, is_least: bool, negated: bool, shown: Shown
    ) -> int:
        """The least or greatest margin of elements compared with a constant, computed from the
        least or greatest element. A subtraction from each element would make infinite elements
        unknown, for example if a laser beam hits nothing.
        """
        holds_above = (node.comparison in _UPWARDS) is not negated
        left = self._folded(node.left, is_least is not holds_above, shown)
        right = self._folded(node.right, is_least is holds_above, shown)
        return self._of_comparison(ir.Compare(node.comparison, left, right), negated, shown)

    def _against_a_number(self, proposition: int) -> ir.Compare | None:
        """The comparison of elements with a number beside them (S74), if the proposition is such a
        comparison; else None.
        """
        node = self._nodes.propositions[proposition].node
        is_one = isinstance(node, ir.Compare) and (
            self._is_beside(node.left) is not self._is_beside(node.right)
        )
        return node if isinstance(node, ir.Compare) and is_one else None

    def _is_beside(self, signal: int) -> bool:
        match self._nodes.signals[signal].node:
            case ir.Constant() | ir.Read():
                return True
            case ir.Apply(operands=operands):
                return all(map(self._is_beside, operands))
            case ir.Sampled() | ir.Element() | ir.Fold() | ir.Count():
                return False

    def _of_elements_in_reach(
        self, node: ir.Compare, is_least: bool, negated: bool, shown: Shown
    ) -> int:
        """The least or greatest margin of elements compared with a number beside them, at the
        instant at which the elements arrived. Infinite elements are limited to the greatest double
        before the subtraction. If the result overflows, it is unknown.
        """
        left, right = (
            side if self._is_beside(side) else self._cut(side, shown)
            for side in (node.left, node.right)
        )
        gap = self._of_comparison(ir.Compare(node.comparison, left, right), negated, shown)
        folded = self._nodes.signal(ir.Fold(_folding(is_least), gap), shown)
        twice = self._nodes.apply(ir.Function.ADD, (folded, folded), shown)
        half = self._nodes.constant(0.5, shown)
        return self._nodes.apply(ir.Function.MULTIPLY, (twice, half), shown)

    def _cut(self, signal: int, shown: Shown) -> int:
        high, low = (self._nodes.constant(end, shown) for end in (_GREATEST, -_GREATEST))
        cut = self._nodes.apply(ir.Function.MINIMUM, (signal, high), shown)
        return self._nodes.apply(ir.Function.MAXIMUM, (cut, low), shown)

    def _folded(self, signal: int, is_least: bool, shown: Shown) -> int:
        """The least or greatest of a number over elements. A constant is its own result."""
        if self._is_constant(signal):
            return signal
        return self._nodes.signal(ir.Fold(_folding(is_least), signal), shown)

    def _is_constant(self, signal: int) -> bool:
        return isinstance(self._nodes.signals[signal].node, ir.Constant)

    def _gap(self, left: int, right: int, shown: Shown) -> int:
        return self._nodes.apply(ir.Function.SUBTRACT, (left, right), shown)

    def _extreme(self, operands: list[int], *, is_least: bool, shown: Shown) -> int:
        function = ir.Function.MINIMUM if is_least else ir.Function.MAXIMUM
        first, *rest = operands
        for other in rest:
            first = self._nodes.apply(function, (first, other), shown)
        return first

    def _shown(self, proposition: int, negated: bool) -> Shown:
        """The words of a margin, with the place of its condition."""
        found = self._nodes.propositions[proposition]
        text = f"not ({found.text})" if negated else found.text
        return Shown(f"margin of {text}", found.span)


def _folding(is_least: bool) -> ir.Folding:
    return ir.Folding.MINIMUM if is_least else ir.Folding.MAXIMUM
