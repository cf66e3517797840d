"""Signals and propositions over the elements of an array or a list (rules S22 to S26, S51 to S54,
S74).

Every result over an unknown array is unknown. An array is unknown if it has not arrived, has
expired, is empty, or is a list of too many elements. A list without elements is known.
"""

from __future__ import annotations

import math
from functools import reduce

from rossmarie import ir
from rossmarie.interpreter import arithmetic
from rossmarie.interpreter.arithmetic import NAN
from rossmarie.interpreter.memory import MachineMemory
from rossmarie.ir import TruthValue, kleene
from rossmarie.ir.comparison import compare, is_between, is_set


class ElementEvaluation:
    """Evaluates elementwise nodes, once for each element of an array, with the numbers of the
    evaluation in which the elements arrive.
    """

    def __init__(self, machine: ir.Machine, memory: MachineMemory) -> None:
        self._machine = machine
        self._memory = memory
        self._arrays = ir.element_arrays(machine)

    def fold(self, node: ir.Fold) -> float:
        """The least or greatest element. NaN if an element is NaN, or if the array is unknown
        (S23). Over an empty list, the result is the neutral element of the fold (S53).
        """
        if not self._is_known(self._arrays.signals[node.element]):
            return NAN
        function = node.folding.function
        first = math.inf if node.folding is ir.Folding.MINIMUM else -math.inf
        values = self.values(node.element)
        return reduce(lambda found, each: arithmetic.plain(function, (found, each)), values, first)

    def count(self, node: ir.Count) -> float:
        """The number of elements for which a proposition is true. NaN if the proposition is unknown
        for an element, or if the array is unknown (S24).
        """
        values = self._propositions(node.element)
        if (
            not self._is_known(self._arrays.propositions[node.element])
            or TruthValue.UNKNOWN in values
        ):
            return NAN
        return float(values.count(TruthValue.TRUE))

    def quantified(self, node: ir.Quantified) -> TruthValue:
        """Kleene's disjunction or conjunction over the elements. Unknown if the array is unknown
        (S25).
        """
        if not self._is_known(self._arrays.propositions[node.element]):
            return TruthValue.UNKNOWN
        values = self._propositions(node.element)
        is_any = node.quantifier is ir.Quantifier.ANY
        return kleene.disjunction(values) if is_any else kleene.conjunction(values)

    def _is_known(self, array: int | None) -> bool:
        assert array is not None, "verified: only elementwise nodes are folded"
        return self._memory.arrays[array] is not None

    def _propositions(self, index: int) -> list[TruthValue]:
        array = self._arrays.propositions[index]
        assert array is not None, (
            "verified: only elementwise propositions are quantified and counted"
        )
        return [self._proposition(index, place) for place in self._places(array)]

    def values(self, index: int) -> list[float]:
        """An elementwise signal, for each element."""
        array = self._arrays.signals[index]
        assert array is not None, "verified: only elementwise signals are folded"
        return [self._signal(index, place) for place in self._places(array)]

    def _places(self, array: int) -> range:
        return range(len(self._memory.arrays[array] or ()))

    def _signal(self, index: int, place: int) -> float:
        if self._arrays.signals[index] is None:
            # S74: signals precede their users, so this signal has its present value.
            return self._memory.signals[index]
        match self._machine.signals[index].node:
            case ir.Element(array=array):
                elements = self._memory.arrays[array]
                assert elements is not None, "all columns of a list are known, or none"
                return elements[place]
            case ir.Apply(function=function, operands=operands):
                values = tuple(self._signal(operand, place) for operand in operands)
                return arithmetic.apply(function, values)
            case (
                ir.Constant() | ir.Read() | ir.Sampled() | ir.Fold() | ir.Count()
            ) as node:  # fmt: skip
                raise AssertionError(f"verified: {type(node).__name__} is not elementwise")

    def _proposition(self, index: int, place: int) -> TruthValue:
        match self._machine.propositions[index].node:
            case ir.Literal(value=value):
                return kleene.proposition_of(value)
            case ir.Compare(comparison=comparison, left=left, right=right):
                return compare(comparison, self._signal(left, place), self._signal(right, place))
            case ir.Between(signal=signal, low=low, high=high):
                return is_between(
                    self._signal(signal, place), self._signal(low, place), self._signal(high, place)
                )
            case ir.Flag(signal=signal):
                return is_set(self._signal(signal, place))
            case ir.Not(operand=operand):
                return kleene.negation(self._proposition(operand, place))
            case ir.And(operands=operands):
                return kleene.conjunction(self._proposition(operand, place) for operand in operands)
            case ir.Or(operands=operands):
                return kleene.disjunction(self._proposition(operand, place) for operand in operands)
            case (
                ir.AgeReaches() | ir.Oscillates() | ir.Quantified() | ir.Held() | ir.Since()
                | ir.Recurs()
            ) as node:  # fmt: skip
                raise AssertionError(f"verified: {type(node).__name__} is not elementwise")
