"""Signals and truths over the elements of an array (rules S22 to S26).

An array that has not arrived, is empty or has expired is the empty sequence; every result over it
is unknown.
"""

from __future__ import annotations

from functools import reduce

from rossmarie import ir
from rossmarie.interpreter import arithmetic
from rossmarie.interpreter.arithmetic import NAN
from rossmarie.interpreter.memory import Memory
from rossmarie.ir import TruthValue, kleene
from rossmarie.ir.comparison import compare, is_between, is_set


class Elements:
    """Evaluates what exists once for each element of an array."""

    def __init__(self, machine: ir.Machine, memory: Memory) -> None:
        self._machine = machine
        self._memory = memory
        self._arrays = ir.element_arrays(machine)

    def fold(self, node: ir.Fold) -> float:
        """The least or greatest element; NaN if one is NaN, or there is none (S23)."""
        values = self.values(node.element)
        if not values:
            return NAN
        function = node.folding.function
        return reduce(lambda found, each: arithmetic.plain(function, (found, each)), values)

    def count(self, node: ir.Count) -> float:
        """For how many elements a truth is true; NaN if one is unknown, or there is none (S24)."""
        values = self._truths(node.element)
        if not values or TruthValue.UNKNOWN in values:
            return NAN
        return float(values.count(TruthValue.TRUE))

    def quantified(self, node: ir.Quantified) -> TruthValue:
        """Kleene's disjunction or conjunction over the elements; of none, unknown (S25)."""
        values = self._truths(node.element)
        if not values:
            return TruthValue.UNKNOWN
        is_any = node.quantifier is ir.Quantifier.ANY
        return kleene.disjunction(values) if is_any else kleene.conjunction(values)

    def _truths(self, index: int) -> list[TruthValue]:
        array = self._arrays.truths[index]
        assert array is not None, "verified: only elementwise truths are quantified and counted"
        return [self._truth(index, x) for x in self._memory.arrays[array]]

    def values(self, index: int) -> list[float]:
        """An elementwise signal, for each element."""
        array = self._arrays.signals[index]
        assert array is not None, "verified: only elementwise signals are folded"
        return [self._signal(index, x) for x in self._memory.arrays[array]]

    def _signal(self, index: int, x: float) -> float:
        match self._machine.signals[index].node:
            case ir.Element():
                return x
            case ir.Constant(value=value):
                return value
            case ir.Apply(function=function, operands=operands):
                values = tuple(self._signal(operand, x) for operand in operands)
                return arithmetic.apply(function, values)
            case (ir.Read() | ir.Sampled() | ir.Fold() | ir.Count()) as node:
                raise AssertionError(f"verified: {type(node).__name__} is not elementwise")

    def _truth(self, index: int, x: float) -> TruthValue:
        match self._machine.truths[index].node:
            case ir.Literal(value=value):
                return kleene.truth_of(value)
            case ir.Compare(comparison=comparison, left=left, right=right):
                return compare(comparison, self._signal(left, x), self._signal(right, x))
            case ir.Between(signal=signal, low=low, high=high):
                return is_between(
                    self._signal(signal, x), self._signal(low, x), self._signal(high, x)
                )
            case ir.Flag(signal=signal):
                return is_set(self._signal(signal, x))
            case ir.Not(operand=operand):
                return kleene.negation(self._truth(operand, x))
            case ir.And(operands=operands):
                return kleene.conjunction(self._truth(operand, x) for operand in operands)
            case ir.Or(operands=operands):
                return kleene.disjunction(self._truth(operand, x) for operand in operands)
            case (
                ir.AgeReaches() | ir.Oscillates() | ir.Quantified() | ir.Held() | ir.Since()
             | ir.Recurs()
            ) as node:  # fmt: skip
                raise AssertionError(f"verified: {type(node).__name__} is not elementwise")
