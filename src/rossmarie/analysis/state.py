"""An arbitrary well-formed state at any evaluation of any trace.

Every reachable state is one of these states, so a predicate that is true in all of them is always
true. The opposite does not follow: memories (`for`, `rate`, `previous`, `oscillates`) have any
value that fits the present value of their operand, and the memory of a `since` has any value.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import z3

from rossmarie import ir
from rossmarie.analysis.calls import Calls
from rossmarie.analysis.encoding import Cell, Encoding, Questioned
from rossmarie.analysis.fields import limit_facts, slot_facts
from rossmarie.analysis.quantities import quantity_facts
from rossmarie.analysis.terms import NumberTerm, PropositionTerm, choice, free_fact, literal
from rossmarie.ir import TruthValue


class ArbitraryState(Encoding):
    """Any state at an evaluation.

    `settled` excludes the time in which a `for` is not true yet although its condition is true. A
    proposition that is false only in this time is false only at the beginning.
    """

    rounded = True

    def __init__(self, asked: Questioned, *, settled: bool = False) -> None:
        super().__init__(asked)
        self._settled = settled
        self._slots: dict[int, NumberTerm] = {}
        self._calls = Calls(self.machine, "state")
        self._cells: dict[int, Sequence[Cell]] = {}
        self._before: dict[int, PropositionTerm] = {}
        self._elapsed: dict[int, z3.ArithRef] = {}
        self._ages: dict[int, z3.ArithRef] = {}

    def slot(self, index: int) -> NumberTerm:
        """Any value of the slot's kind, while the input is fresh."""
        if index not in self._slots:
            slot = self.machine.slots[index]
            value, known = z3.Real(f"slot{index}"), z3.Bool(f"slot{index}.known")
            self.facts += slot_facts(self.machine, slot, value, rounded=True)
            self.facts += self._calls.facts(slot, value)
            self.facts.append(z3.Implies(known, self.is_fresh(slot.input)))
            self._slots[index] = NumberTerm(known, value)
            for other, number in self._slots.items():
                pair = {index: self._slots[index], other: number}
                self.facts += quantity_facts(self.machine, pair)
        return self._slots[index]

    def cells(self, array: int) -> Sequence[Cell]:
        """The elements of an array while its input is fresh: as many as can affect the result."""
        if array not in self._cells:
            cells = [
                Cell(
                    array,
                    z3.Bool(f"array{array}.{i}"),
                    NumberTerm(
                        z3.Bool(f"array{array}.{i}.known"), z3.Real(f"array{array}.{i}.value")
                    ),
                )
                for i in range(self.asked.array_uses[array])
            ]
            self.facts += shape_facts(cells)
            for cell in cells:
                source = self.machine.arrays[array]
                self.facts += limit_facts(source, cell.number.value, rounded=True)
            fresh = self.is_fresh(self.machine.arrays[array].input)
            self.facts.append(z3.Implies(cells[0].is_there, fresh))
            self._cells[array] = cells
        return self._cells[array]

    def has_arrived(self, channel: int) -> z3.BoolRef:
        """Any Boolean."""
        return z3.Bool(f"channel{channel}.arrived")

    def age(self, channel: int) -> z3.ArithRef:
        """Any age."""
        if channel not in self._ages:
            self._ages[channel] = z3.Int(f"channel{channel}.age")
            self.facts.append(self._ages[channel] >= 0)
        return self._ages[channel]

    def sampled(self, _: int, node: ir.Sampled) -> NumberTerm:
        """Any number; samples do not outlive their inputs (S21)."""
        known = z3.FreshBool("sampled")
        support = self.asked.supports.signals[node.signal]
        needed = {self.machine.slots[slot].input for slot in support.slots}
        needed |= {self.machine.arrays[array].input for array in support.arrays}
        for used in sorted(needed):
            self.facts.append(z3.Implies(known, self.is_fresh(used)))
        return NumberTerm(known, z3.FreshReal("sample"))

    def count(self, node: ir.Count) -> NumberTerm:
        """Any number of elements, if all elements are known."""
        array = self.asked.elements.propositions[node.element]
        assert array is not None
        known = [self.is_kept(array), self.cells(array)[0].is_there]
        for cell in self.cells(array):
            found = self.element_proposition(node.element, cell)
            known.append(z3.Implies(cell.is_there, z3.Or(found.true, found.false)))
        number = z3.FreshInt("count")
        self.facts.append(number >= 0)
        return NumberTerm(z3.And(known), z3.ToReal(number))

    def held(self, _: int, node: ir.Held, operand: PropositionTerm) -> PropositionTerm:
        """True once its condition has been true for long enough; before that, the value that the
        condition had earlier.
        """
        if self._settled:
            return operand
        is_true = self.elapsed(node.operand) >= node.duration_ns
        if node.initially:
            is_true = z3.Or(is_true, z3.Bool(f"proposition{node.operand}.initially"))
        return choice(
            operand.true, choice(is_true, literal(True), self.before(node.operand)), operand
        )

    def before(self, operand: int) -> PropositionTerm:
        """The value that a proposition had before; the proposition is now true."""
        if operand not in self._before:
            found = free_fact(f"proposition{operand}.before", self.facts)
            self.facts.append(z3.Not(found.true))
            if not self.asked.has_timeout(self.asked.supports.propositions[operand].inputs):
                self.facts.append(z3.Not(found.stale))
            self._before[operand] = found
        return self._before[operand]

    def elapsed(self, operand: int) -> z3.ArithRef:
        """The time in ns for which a proposition has been true; the proposition is now true."""
        if operand not in self._elapsed:
            self._elapsed[operand] = z3.Int(f"proposition{operand}.elapsed")
            self.facts.append(self._elapsed[operand] >= 0)
        return self._elapsed[operand]

    @property
    def awaited(self) -> tuple[int, ...]:
        """The propositions for which `elapsed` was called."""
        return tuple(self._elapsed)

    def is_longer(self, operand: int, other: int) -> z3.BoolRef:
        """The fact that a proposition, which is true only while another one is, has not been true
        for longer.
        """
        return z3.Implies(
            self.proposition(operand).true, self.elapsed(other) >= self.elapsed(operand)
        )

    def is_unknown_with(self, operand: int, other: int, value: TruthValue) -> z3.BoolRef:
        """A further fact, if one proposition cannot be U, or S, while another proposition is not:
        if it had this value before, both became true together. A jump in time makes both U (S17).
        """
        was_unknown = z3.And(self.proposition(operand).true, self.before(operand).is_value(value))
        is_equal = self.elapsed(other) == self.elapsed(operand)
        return z3.Implies(was_unknown, z3.And(self.before(other).is_value(value), is_equal))

    def remembered(self, index: int) -> PropositionTerm:
        """Any value, whatever the present values of its operands."""
        found = free_fact(f"proposition{index}.remembered", self.facts)
        if not self.asked.has_timeout(self.asked.supports.propositions[index].inputs):
            self.facts.append(z3.Not(found.stale))
        return found

    def oscillating(self, index: int) -> PropositionTerm:
        """Any value."""
        return free_fact(f"proposition{index}", self.facts)

    def recurring(self, index: int, _: ir.Recurs) -> PropositionTerm:
        """Any value, because past edges are not encoded."""
        return free_fact(f"proposition{index}", self.facts)


def shape_facts(cells: Sequence[Cell]) -> list[z3.BoolRef]:
    """The fact that an array has no gaps."""
    return [
        z3.Implies(later.is_there, earlier.is_there) for earlier, later in itertools.pairwise(cells)
    ]
