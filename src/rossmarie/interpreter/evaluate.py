"""One evaluation: every signal, then every proposition, from left to right.

The inputs in memory are up to date before an evaluation. All nodes are evaluated each time; a
target may skip nodes that cannot have changed.
"""

from __future__ import annotations

import math

from rossmarie import ir
from rossmarie.core import SampleNumber, sampling_row
from rossmarie.interpreter import arithmetic
from rossmarie.interpreter.arithmetic import NAN
from rossmarie.interpreter.elements import ElementEvaluation
from rossmarie.interpreter.memory import MachineMemory, Samples
from rossmarie.ir import InputState, TruthValue, kleene
from rossmarie.ir.comparison import compare, is_between, is_set


class Evaluator:
    """Computes the signals and propositions of a machine into its memory."""

    def __init__(self, machine: ir.Machine, memory: MachineMemory) -> None:
        self._machine = machine
        self._memory = memory
        self._supports = ir.supports(machine)
        self._element_arrays = ir.element_arrays(machine)
        self.elements = ElementEvaluation(machine, memory)

    def evaluate(self, at_ns: int, updated: frozenset[int], expired: frozenset[int]) -> None:
        """Evaluate at an instant at which these channels were updated and these inputs have
        expired.
        """
        for index, signal in enumerate(self._machine.signals):
            if self._element_arrays.signals[index] is None:
                value = self._signal(index, signal.node, at_ns, updated, expired)
                self._memory.signals[index] = value
        for index, proposition in enumerate(self._machine.propositions):
            if self._element_arrays.propositions[index] is None:
                value = self._proposition(index, proposition.node, at_ns, updated, expired)
                self._record(index, value, at_ns)

    def _record(self, index: int, value: TruthValue, at_ns: int) -> None:
        """S34: record the instant at which a proposition got its value. The first evaluation counts
        as a change.
        """
        if self._memory.truth_values[index] is not value:
            self._memory.truth_values[index] = value
            self._memory.since_ns[index] = at_ns

    # --- signals -----------------------------------------------------------------------------

    def _signal(
        self,
        index: int,
        node: ir.SignalNode,
        at_ns: int,
        updated: frozenset[int],
        expired: frozenset[int],
    ) -> float:
        match node:
            case ir.Constant(value=value):
                return value
            case ir.Read(slot=slot):
                return self._memory.slots[slot]
            case ir.Apply(function=function, operands=operands):
                values = tuple(self._memory.signals[operand] for operand in operands)
                return arithmetic.apply(function, values)
            case ir.Sampled():
                return self._sampled(index, node, at_ns, updated, expired)
            case ir.Fold() | ir.Count():
                return self._folded(index, node, updated, expired)
            case ir.Element():
                raise AssertionError("an element has no value of its own")

    def _folded(
        self,
        index: int,
        node: ir.Fold | ir.Count,
        updated: frozenset[int],
        expired: frozenset[int],
    ) -> float:
        """S26, S74: results are computed when the elements arrive, and forgotten when an input
        expires.
        """
        support = self._supports.signals[index]
        if support.channels & updated:
            if isinstance(node, ir.Fold):
                return self.elements.fold(node)
            return self.elements.count(node)
        return NAN if support.inputs & expired else self._memory.signals[index]

    def _sampled(
        self,
        index: int,
        node: ir.Sampled,
        at_ns: int,
        updated: frozenset[int],
        expired: frozenset[int],
    ) -> float:
        """S18 and S21: take a sample. A function that feeds back stores its result instead of a
        sample.
        """
        support = self._supports.signals[node.signal]
        samples = self._memory.samples[index]
        feeds_back = sampling_row(node.function).feeds_back
        if support.inputs & expired:
            samples.forget()
        if support.channels & updated:
            samples.take(self._memory.signals[node.signal], at_ns)
            if feeds_back:
                samples.take(_of_samples(node.function, samples), at_ns)
        return (
            samples.view(SampleNumber.NEWEST) if feeds_back else _of_samples(node.function, samples)
        )

    # --- propositions
    # ------------------------------------------------------------------------------

    def _proposition(
        self,
        index: int,
        node: ir.PropositionNode,
        at_ns: int,
        updated: frozenset[int],
        expired: frozenset[int],
    ) -> TruthValue:
        match node:
            case ir.Literal(value=value):
                return kleene.proposition_of(value)
            case ir.Not(operand=operand):
                return kleene.negation(self._known(operand))
            case ir.And(operands=operands):
                return kleene.conjunction(self._known(operand) for operand in operands)
            case ir.Or(operands=operands):
                return kleene.disjunction(self._known(operand) for operand in operands)
            case ir.Held():
                return self._held(index, node, at_ns)
            case ir.Since():
                return self._since(index, node)
            case ir.Recurs():
                return self._recurs(index, node, at_ns)
            case ir.Oscillates():
                return self._oscillates(index, node, at_ns, updated)
            case ir.Quantified():
                found = self._quantified(index, node, updated, expired)
                return self._unknown(index, node) if found is TruthValue.UNKNOWN else found
            case ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches():
                found = self._leaf(node, at_ns)
                return self._unknown(index, node) if found is TruthValue.UNKNOWN else found

    def _known(self, index: int) -> TruthValue:
        value = self._memory.truth_values[index]
        assert value is not None, "operands stand before their users"
        return value

    def _leaf(
        self, node: ir.Compare | ir.Between | ir.Flag | ir.AgeReaches, at_ns: int
    ) -> TruthValue:
        signals = self._memory.signals
        match node:
            case ir.Compare(comparison=comparison, left=left, right=right):
                return compare(comparison, signals[left], signals[right])
            case ir.Between(signal=signal, low=low, high=high):
                return is_between(signals[signal], signals[low], signals[high])
            case ir.Flag(signal=signal):
                return is_set(signals[signal])
            case ir.AgeReaches():
                return self._age_reaches(node, at_ns)

    def _quantified(
        self,
        index: int,
        node: ir.Quantified,
        updated: frozenset[int],
        expired: frozenset[int],
    ) -> TruthValue:
        """S26, S74: the same as for folds."""
        support = self._supports.propositions[index]
        if support.channels & updated:
            self._memory.quantified[index] = self.elements.quantified(node)
        elif support.inputs & expired:
            self._memory.quantified[index] = TruthValue.UNKNOWN
        return self._memory.quantified[index]

    def _unknown(self, index: int, node: ir.PropositionNode) -> TruthValue:
        """S30: an unknown leaf is stale if the cause is a missing input with a timeout."""
        support = self._supports.propositions[index]
        lacking = {
            self._machine.slots[slot].input
            for slot in support.slots
            if math.isnan(self._memory.slots[slot])
        }
        for fold in support.folds:
            if math.isnan(self._memory.signals[fold]):
                lacking |= self._supports.signals[fold].inputs
        is_whole = isinstance(node, ir.Quantified | ir.AgeReaches)
        if is_whole or not self._is_excused(support):
            lacking |= support.inputs
        is_stale = any(self._machine.inputs[used].timeout_ns is not None for used in lacking)
        return TruthValue.STALE if is_stale else TruthValue.UNKNOWN

    def _is_excused(self, support: ir.Support) -> bool:
        """S30: say whether operands, not arithmetic, make a leaf unknown: a missing number,
        elements out of range (REP 117), an empty list, or a sample that has not come yet.
        """
        memory, supports = self._memory, self._supports.signals
        values = [memory.slots[slot] for slot in support.slots]
        values += [memory.signals[signal] for signal in support.folds | support.samples]
        of_lists = [
            memory.signals[signal]
            for signal in support.folds | support.samples
            if ir.is_of_list(self._machine, supports[signal])
        ]
        return not all(value < math.inf for value in values) or -math.inf in of_lists

    def _age_reaches(self, node: ir.AgeReaches, at_ns: int) -> TruthValue:
        """S31: the age of an input."""
        memory = self._memory.inputs[node.input]
        if memory.state is InputState.NEVER:
            return TruthValue.UNKNOWN
        return kleene.proposition_of(at_ns - memory.stamp_ns >= node.age_ns)

    def _oscillates(
        self, index: int, node: ir.Oscillates, at_ns: int, updated: frozenset[int]
    ) -> TruthValue:
        """S32: an oscillation."""
        channels = self._supports.signals[node.signal].channels
        if not channels:
            return TruthValue.FALSE
        oscillation = self._memory.oscillations[index]
        x = self._memory.signals[node.signal]
        source = TruthValue.TRUE
        if not math.isfinite(x):
            oscillation.clear()
            source = self._unknown(index, node)
        elif channels & updated:
            oscillation.take(x, node.swing, at_ns)
        return oscillation.recent.look(source, node.window_ns, at_ns)

    def _recurs(self, index: int, node: ir.Recurs, at_ns: int) -> TruthValue:
        """S48: a count of edges."""
        operand = self._known(node.operand)
        recurrence = self._memory.recurrences[index]
        recurrence.take(operand, at_ns)
        return recurrence.recent.look(operand, node.window_ns, at_ns)

    def _held(self, index: int, node: ir.Held, at_ns: int) -> TruthValue:
        """S33: a `for`."""
        operand = self._known(node.operand)
        held = self._memory.held[index]
        if operand is not TruthValue.TRUE:
            held.start_ns, held.before = None, operand
            return operand
        if held.start_ns is None:
            held.start_ns = at_ns
        return TruthValue.TRUE if at_ns - held.start_ns >= node.duration_ns else held.before

    def _since(self, index: int, node: ir.Since) -> TruthValue:
        """S44: a `since`."""
        held, begun = self._known(node.held), self._known(node.begun)
        before = kleene.disjunction((begun, self._memory.since[index]))
        value = kleene.disjunction((begun, kleene.conjunction((held, before))))
        self._memory.since[index] = value
        return value


def _of_samples(function: ir.Sampling, samples: Samples) -> float:
    views = tuple(map(samples.view, sampling_row(function).views))
    return arithmetic.of_samples(function, views)
