"""One evaluation of a machine (S11) as terms of the solver.

Signals and propositions become terms node by node, as the interpreter evaluates them. The two
subclasses add the environment of the evaluation. In `state.ArbitraryState`, memories have any value
that a trace could have left there; `trace.Moment` is part of a trace of events.
`testing.solve.World` is not a subclass, and explains why. The common code is in `terms`, `formulas`
and `fields`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import z3

from rossmarie import ir
from rossmarie.analysis import arithmetic, lists
from rossmarie.analysis.once import once_each
from rossmarie.analysis.terms import (
    NO,
    YES,
    NumberTerm,
    PropositionTerm,
    conjunction,
    constant,
    disjunction,
    holds,
    joined,
    literal,
)


@dataclass(frozen=True)
class Cell:
    """An element of an array, if the array is long enough."""

    array: int
    is_there: z3.BoolRef
    number: NumberTerm


class Questioned:
    """A machine, with the results that every query about it needs."""

    def __init__(self, machine: ir.Machine) -> None:
        self.machine = machine
        self.supports = ir.supports(machine)
        self.elements = ir.element_arrays(machine)
        self.beside = ir.beside(machine)

    @cached_property
    def array_uses(self) -> tuple[int, ...]:
        """For each array, the number of nodes that use it. This many elements, plus one, can show
        every behavior that an array of any length can show to these nodes.
        """
        uses = [1] * len(self.machine.arrays)
        for signal in self.machine.signals:
            match signal.node:
                case ir.Fold(element=element):
                    uses[self._array(self.elements.signals[element])] += 1
                case ir.Count(element=element):
                    uses[self._array(self.elements.propositions[element])] += 1
                case (
                    ir.Constant() | ir.Read() | ir.Apply() | ir.Sampled()
                    | ir.Element()
                ):  # fmt: skip
                    pass
        for proposition in self.machine.propositions:
            if isinstance(proposition.node, ir.Quantified):
                uses[self._array(self.elements.propositions[proposition.node.element])] += 1
        return tuple(uses)

    def _array(self, array: int | None) -> int:
        assert array is not None, "verified: only elements are folded"
        return array

    def window_of(self, signal: int) -> int:
        """The time in ns that a signal looks back: its window or its time constant; 0 if it has
        neither.
        """
        node = self.machine.signals[signal].node
        return node.window_ns if isinstance(node, ir.Sampled) else 0

    def has_timeout(self, inputs: Iterator[int] | Sequence[int] | frozenset[int]) -> bool:
        """Say whether at least one of some inputs can be stale."""
        return any(self.machine.inputs[used].timeout_ns is not None for used in inputs)


class Encoding(ABC):
    """The signals and propositions of one evaluation. `facts` are true in all cases.

    With `rounded`, numbers cover all values that doubles can give; otherwise they are exact.
    """

    rounded: bool

    def __init__(self, asked: Questioned) -> None:
        self.asked = asked
        self.machine = asked.machine
        self.facts: list[z3.BoolRef] = []
        self._signals: dict[int, NumberTerm] = {}
        self._propositions: dict[int, PropositionTerm] = {}

    @property
    def known_signals(self) -> frozenset[int]:
        """The indices of the requested signals."""
        return frozenset(self._signals)

    # --- what lies outside of one evaluation -------------------------------------------------

    @abstractmethod
    def slot(self, index: int) -> NumberTerm:
        """The value of a slot."""

    @abstractmethod
    def cells(self, array: int) -> Sequence[Cell]:
        """The elements of an array; none if the array has not arrived or has expired."""

    @abstractmethod
    def has_arrived(self, channel: int) -> z3.BoolRef:
        """Say whether any message has come on a channel."""

    @abstractmethod
    def age(self, channel: int) -> z3.ArithRef:
        """The age of the last message, in ns."""

    @abstractmethod
    def sampled(self, index: int, node: ir.Sampled) -> NumberTerm:
        """S18 to S21, S43, S49, S50: a function of samples."""

    @abstractmethod
    def count(self, node: ir.Count) -> NumberTerm:
        """S24: a count of elements."""

    @abstractmethod
    def held(self, index: int, node: ir.Held, operand: PropositionTerm) -> PropositionTerm:
        """S33: a `for`."""

    @abstractmethod
    def remembered(self, index: int) -> PropositionTerm:
        """S44: the value of a `since` at the last evaluation."""

    @abstractmethod
    def oscillating(self, index: int) -> PropositionTerm:
        """S32: an oscillation, if the signal is known."""

    @abstractmethod
    def recurring(self, index: int, node: ir.Recurs) -> PropositionTerm:
        """S48: a count of edges."""

    # --- inputs ------------------------------------------------------------------------------

    @once_each
    def is_fresh(self, used: int) -> z3.BoolRef:
        """Say whether an input has arrived and has not expired (S10)."""
        declared = self.machine.inputs[used]
        arrived = self.has_arrived(declared.channel)
        if declared.timeout_ns is None:
            return arrived
        return z3.And(arrived, self.age(declared.channel) < declared.timeout_ns)

    # --- signals -----------------------------------------------------------------------------

    def signal(self, index: int) -> NumberTerm:
        """A signal that has one value for the whole machine."""
        if index not in self._signals:
            self._signals[index] = self._signal(index, self.machine.signals[index].node)
        return self._signals[index]

    def _signal(self, index: int, node: ir.SignalNode) -> NumberTerm:
        match node:
            case ir.Constant(value=value):
                return NumberTerm(YES, constant(value))
            case ir.Read(slot=slot):
                return self.slot(slot)
            case ir.Apply(function=function, operands=operands):
                numbers = [self.signal(operand) for operand in operands]
                return self.apply(index, function, numbers)
            case ir.Sampled():
                return self.sampled(index, node)
            case ir.Fold(element=element):
                its_list = lists.list_of(self.machine, self.asked.elements.signals[element])
                return self._fold(node) if its_list is None else lists.folded(self, its_list, node)
            case ir.Count(element=element):
                its_list = lists.list_of(self.machine, self.asked.elements.propositions[element])
                return self.count(node) if its_list is None else lists.counted(self, its_list)
            case ir.Element():
                raise AssertionError("an element has no value of its own")

    def apply(
        self, index: int, function: ir.AnyFunction, numbers: Sequence[NumberTerm]
    ) -> NumberTerm:
        """A function of other signals, or of an element."""
        result = arithmetic.apply(function, numbers, self.facts, rounded=self.rounded)
        support = self.asked.supports.signals[index]
        if self.rounded and (support.arrays or support.samples):
            # An element may be infinite (S8). Results computed from an infinite element are
            # unknown.
            return NumberTerm(z3.And(result.known, z3.FreshBool("finite")), result.value)
        return result

    def _fold(self, node: ir.Fold) -> NumberTerm:
        array = self.asked.elements.signals[node.element]
        assert array is not None
        cells = self.cells(array)
        numbers = [self._element_signal(node.element, cell) for cell in cells]
        result = z3.FreshReal("fold")
        pairs = list(zip(cells, numbers, strict=True))
        is_minimum = node.folding is ir.Folding.MINIMUM
        self.facts += [
            z3.Implies(
                cell.is_there,
                result <= number.value if is_minimum else result >= number.value,
            )
            for cell, number in pairs
        ]
        is_one = [z3.And(cell.is_there, result == number.value) for cell, number in pairs]
        known = [z3.Implies(cell.is_there, number.known) for cell, number in pairs]
        self.facts.append(z3.Implies(cells[0].is_there, z3.Or(is_one)))
        return NumberTerm(z3.And(self.is_kept(array), cells[0].is_there, *known), result)

    # --- propositions
    # ------------------------------------------------------------------------------

    def proposition(self, index: int) -> PropositionTerm:
        """A proposition that has one value for the whole machine."""
        if index not in self._propositions:
            for below in ir.reachable_propositions(self.machine, index):
                if below not in self._propositions:
                    self._propositions[below] = self._proposition(
                        below, self.machine.propositions[below].node
                    )
        return self._propositions[index]

    def _proposition(self, index: int, node: ir.PropositionNode) -> PropositionTerm:
        match node:
            case ir.Literal() | ir.Not() | ir.And() | ir.Or():
                return joined(
                    node, [self._propositions[each] for each in ir.proposition_operands(node)]
                )
            case ir.Held(operand=operand):
                return self.held(index, node, self._propositions[operand])
            case ir.Since(held=held, begun=begun):
                return self._since(index, self._propositions[held], self._propositions[begun])
            case ir.Recurs():
                return self.recurring(index, node)
            case ir.Oscillates(signal=signal):
                return self._oscillates(index, node, self.signal(signal))
            case ir.AgeReaches(input=used, age_ns=age_ns):
                channel = self.machine.inputs[used].channel
                reached = self.age(channel) >= age_ns
                return self._leaf(index, node, self.has_arrived(channel), reached)
            case ir.Quantified():
                return self._quantified(index, node)
            case ir.Compare() | ir.Between() | ir.Flag():
                numbers = [self.signal(signal) for signal in ir.compared_signals(node)]
                known = z3.And([number.known for number in numbers])
                values = [number.value for number in numbers]
                return self._leaf(index, node, known, holds(node, values))

    def _since(self, index: int, held: PropositionTerm, begun: PropositionTerm) -> PropositionTerm:
        """S44: a `since`."""
        before = disjunction([begun, self.remembered(index)])
        return disjunction([begun, conjunction([held, before])])

    def _leaf(
        self, index: int, node: ir.PropositionNode, known: z3.BoolRef, is_so: z3.BoolRef
    ) -> PropositionTerm:
        unknown = z3.Not(known)
        stale = z3.And(unknown, self.is_stale(index, node))
        return PropositionTerm(z3.And(known, is_so), z3.And(known, z3.Not(is_so)), stale)

    def is_stale(self, index: int, node: ir.PropositionNode) -> z3.BoolRef:
        """S30: say whether an unknown leaf is unknown because of an input with a timeout."""
        support = self.asked.supports.propositions[index]
        if not self.asked.has_timeout(support.inputs):
            return NO
        if isinstance(node, ir.Quantified | ir.AgeReaches):
            return YES
        slots = {slot: self.slot(slot).known for slot in support.slots}
        lacking = [
            z3.Not(known)
            for slot, known in slots.items()
            if self.asked.has_timeout((self.machine.slots[slot].input,))
        ]
        lacking += [
            z3.Not(self.signal(fold).known)
            for fold in support.folds
            if self.asked.has_timeout(self.asked.supports.signals[fold].inputs)
        ]
        complete = z3.And(list(slots.values()))
        if support.folds or support.samples:
            # Unknown or infinite inputs excuse a leaf as well.
            complete = z3.And(complete, z3.FreshBool("complete")) if self.rounded else NO
        return z3.Or(*lacking, complete)

    def _oscillates(self, index: int, node: ir.Oscillates, number: NumberTerm) -> PropositionTerm:
        if not self.asked.supports.signals[node.signal].channels:
            return literal(False)
        unknown = z3.Not(number.known)
        found = self.oscillating(index)
        stale = self.is_stale(index, node)
        return PropositionTerm(
            z3.And(number.known, found.true),
            z3.And(number.known, found.false),
            z3.If(unknown, stale, found.stale),
        )

    # --- elements ----------------------------------------------------------------------------

    def _quantified(self, index: int, node: ir.Quantified) -> PropositionTerm:
        array = self.asked.elements.propositions[node.element]
        its_list = lists.list_of(self.machine, array)
        if its_list is not None:
            return lists.quantified(self, its_list, index, node)
        assert array is not None
        cells = self.cells(array)
        is_any = node.quantifier is ir.Quantifier.ANY
        neutral = literal(not is_any)
        parts = []
        for cell in cells:
            found = self.element_proposition(node.element, cell)
            parts.append(
                PropositionTerm(
                    z3.If(cell.is_there, found.true, neutral.true),
                    z3.If(cell.is_there, found.false, neutral.false),
                    NO,
                )
            )
        whole = disjunction(parts) if is_any else conjunction(parts)
        there = z3.And(self.is_kept(array), cells[0].is_there)
        true, false = z3.And(there, whole.true), z3.And(there, whole.false)
        unknown = z3.Not(z3.Or(true, false))
        return PropositionTerm(true, false, z3.And(unknown, self.is_stale(index, node)))

    def _element_signal(self, index: int, cell: Cell) -> NumberTerm:
        if self.asked.elements.signals[index] is None:
            return self._beside(cell.array, index)
        match self.machine.signals[index].node:
            case ir.Element():
                return cell.number
            case ir.Apply(function=function, operands=operands):
                numbers = [self._element_signal(operand, cell) for operand in operands]
                return Encoding.apply(self, index, function, numbers)
            case (
                ir.Constant() | ir.Read() | ir.Sampled() | ir.Fold() | ir.Count()
            ) as node:  # fmt: skip
                raise AssertionError(f"verified: {type(node).__name__} is not elementwise")

    def _beside(self, array: int, signal: int) -> NumberTerm:
        """A number beside elements (S74): any value that the number may have had when the elements
        arrived. A proposed trace of events uses its present value.
        """
        if not self.rounded or isinstance(self.machine.signals[signal].node, ir.Constant):
            return self.signal(signal)
        name = f"array{array}.beside{signal}"
        return NumberTerm(z3.Bool(f"{name}.known"), z3.Real(f"{name}.value"))

    def is_kept(self, array: int) -> z3.BoolRef:
        """Say whether a result over elements is still stored. It is forgotten with the numbers
        beside the elements.
        """
        may_be_stale = self.rounded and array in self.asked.beside
        return z3.FreshBool("kept") if may_be_stale else YES

    def element_proposition(self, index: int, cell: Cell) -> PropositionTerm:
        """The value of a proposition for one element; unknown is never stale here (S22)."""
        node = self.machine.propositions[index].node
        operands = [self.element_proposition(each, cell) for each in ir.proposition_operands(node)]
        match node:
            case ir.Literal() | ir.Not() | ir.And() | ir.Or():
                return joined(node, operands)
            case ir.Compare() | ir.Between() | ir.Flag():
                return self._element_leaf(node, cell)
            case (
                ir.AgeReaches()
                | ir.Oscillates()
                | ir.Quantified()
                | ir.Held()
                | ir.Since()
                | ir.Recurs()
            ):
                raise AssertionError(f"verified: {type(node).__name__} is not elementwise")

    def _element_leaf(self, node: ir.Compare | ir.Between | ir.Flag, cell: Cell) -> PropositionTerm:
        numbers = [self._element_signal(signal, cell) for signal in ir.compared_signals(node)]
        known = z3.And([number.known for number in numbers])
        found = holds(node, [number.value for number in numbers])
        return PropositionTerm(z3.And(known, found), z3.And(known, z3.Not(found)), NO)
