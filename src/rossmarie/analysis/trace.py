"""A trace of events in a few legs, unrolled from its start.

On each leg, some channels send the same message again and again, and the others are silent. A leg
is evaluated twice: at its first message and at its end. The terms only propose a trace: the
interpreter has to confirm it (`shrink`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import z3

from rossmarie import ir
from rossmarie.analysis.calls import Calls
from rossmarie.analysis.encoding import Cell, Encoding, Questioned
from rossmarie.analysis.fields import limit_facts, slot_facts
from rossmarie.analysis.formulas import Formulas, exactly
from rossmarie.analysis.once import once_each
from rossmarie.analysis.quantities import is_quantity, quantity_facts
from rossmarie.analysis.state import shape_facts
from rossmarie.analysis.terms import (
    FALSE,
    NO,
    NumberTerm,
    PropositionTerm,
    choice,
    literal,
)
from rossmarie.analysis.times import SECOND, Times
from rossmarie.core import SampleNumber, sampling_row
from rossmarie.core.expressions import Operand
from rossmarie.ir.calls import query_at


@dataclass(frozen=True)
class Leg:
    """The messages of a leg, as terms. `shakes` are the oscillations of the messages, `calls` the
    running skills that they report.
    """

    sends: dict[int, z3.BoolRef]
    slots: dict[int, NumberTerm]
    cells: dict[int, Sequence[Cell]]
    length_ns: z3.ArithRef
    shakes: dict[int, z3.BoolRef]
    calls: Calls

    @property
    def is_silent(self) -> z3.BoolRef:
        """Say whether a channel is silent."""
        return z3.Not(z3.And(list(self.sends.values())))


class LegMoment(Encoding):
    """The evaluation at the first message of a leg, or at its end."""

    rounded = False

    def __init__(
        self, asked: Questioned, times: Times, leg: Leg, before: LegMoment | None, *, is_end: bool
    ) -> None:
        super().__init__(asked)
        self.leg = leg
        self._times = times
        self._before = before
        self._is_end = is_end
        self._elapsed: dict[int, z3.ArithRef] = {}

    @once_each
    def slot(self, index: int) -> NumberTerm:
        """The value that the leg sends; else the value that was sent before, until it expires."""
        slot = self.machine.slots[index]
        sends = self.leg.sends[self.machine.inputs[slot.input].channel]
        sent = self.leg.slots[index]
        fresh = self.is_fresh(slot.input)
        if self._before is None:
            return NumberTerm(z3.And(sends, fresh, sent.known), sent.value)
        kept = self._before.slot(index)
        known = z3.And(fresh, z3.If(sends, sent.known, kept.known))
        return NumberTerm(known, z3.If(sends, sent.value, kept.value))

    @once_each
    def cells(self, array: int) -> Sequence[Cell]:
        """The elements of an array, in the same way as the value of a slot."""
        used = self.machine.arrays[array].input
        sends = self.leg.sends[self.machine.inputs[used].channel]
        fresh = self.is_fresh(used)
        kept = None if self._before is None else self._before.cells(array)
        found = []
        for i, sent in enumerate(self.leg.cells[array]):
            there, value = z3.And(sends, sent.is_there), sent.number.value
            if kept is not None:
                there = z3.If(sends, sent.is_there, kept[i].is_there)
                value = z3.If(sends, value, kept[i].number.value)
            found.append(Cell(array, z3.And(fresh, there), NumberTerm(sent.number.known, value)))
        return found

    def apply(
        self, index: int, function: ir.AnyFunction, numbers: Sequence[NumberTerm]
    ) -> NumberTerm:
        """A function of unchanged operands is unchanged. Its terms may not imply this, for example
        for an angle or a length.
        """
        result = super().apply(index, function, numbers)
        if self._before is not None and not self.asked.supports.signals[index].samples:
            is_same = z3.BoolVal(True) if self._is_end else z3.Not(self._is_sampled(index))
            same = result.value == self._before.signal(index).value
            self.facts.append(z3.Implies(is_same, same))
        return result

    @once_each
    def has_arrived(self, channel: int) -> z3.BoolRef:
        """Say whether this leg or an earlier leg sends on a channel."""
        earlier = NO if self._before is None else self._before.has_arrived(channel)
        return z3.Or(self.leg.sends[channel], earlier)

    @once_each
    def age(self, channel: int) -> z3.ArithRef:
        """The age of the last message: 0 at each message."""
        passed = z3.IntVal(0)
        if self._before is not None:
            gap = self.leg.length_ns if self._is_end else self._times.period_ns
            passed = self._before.age(channel) + gap
        return z3.If(self.leg.sends[channel], z3.IntVal(0), passed)

    @once_each
    def _is_sampled(self, signal: int) -> z3.BoolRef:
        """Say whether this leg contains samples of a signal."""
        channels = self.asked.supports.signals[signal].channels
        return z3.Or([self.leg.sends[channel] for channel in channels])

    def sampled(self, index: int, node: ir.Sampled) -> NumberTerm:
        """A step at the first message, then no change; before the message, the old value."""
        declared = sampling_row(node.function)
        number, brings = self.signal(node.signal), self._is_sampled(node.signal)
        at_rest = Formulas([number.value], exactly).term(declared.at_rest(Operand(0)))
        if self._before is None:
            known = z3.And(brings, number.known) if declared.takes_time else NO
            return NumberTerm(known, at_rest)
        earlier = self._before.signal(index)
        needed = [number.known] if SampleNumber.NEWEST in declared.views else []
        if self._is_end:
            known = z3.And(z3.If(brings, number.known, earlier.known), *needed)
            return NumberTerm(known, z3.If(brings, at_rest, earlier.value))
        if declared.takes_time:
            return earlier
        last = self._before.signal(node.signal)
        known = z3.If(brings, z3.And(last.known, *needed), earlier.known)
        views = [self._view(view, number, last) for view in declared.views]
        step = Formulas(views, exactly).term(declared.expression)
        return NumberTerm(known, z3.If(brings, step, earlier.value))

    def _view(self, view: SampleNumber, number: NumberTerm, last: NumberTerm) -> z3.ArithRef:
        """The value of a view at the first message of a leg."""
        match view:
            case SampleNumber.NEWEST:
                return number.value
            case SampleNumber.BEFORE:
                return last.value
            case SampleNumber.SECONDS:
                return z3.Q(self._times.period_ns, SECOND)
            case (
                SampleNumber.LOWER
                | SampleNumber.UPPER
                | SampleNumber.TOTAL
                | SampleNumber.COUNT
                | SampleNumber.CONSTANT
            ):
                raise AssertionError("windows and filters are not looked into")

    def count(self, node: ir.Count) -> NumberTerm:
        """The number of elements for which the proposition is true."""
        array = self.asked.elements.propositions[node.element]
        assert array is not None
        cells = self.cells(array)
        found = [self.element_proposition(node.element, cell) for cell in cells]
        pairs = list(zip(cells, found, strict=True))
        ones = [z3.If(z3.And(cell.is_there, one.true), 1, 0) for cell, one in pairs]
        known = [z3.Implies(cell.is_there, z3.Or(one.true, one.false)) for cell, one in pairs]
        return NumberTerm(z3.And(cells[0].is_there, *known), z3.ToReal(z3.Sum(ones)))

    def held(self, _: int, node: ir.Held, operand: PropositionTerm) -> PropositionTerm:
        """True once the operand has been true for long enough; before that, the value that the
        operand had earlier.
        """
        matured = self.elapsed(node.operand) >= node.duration_ns
        was = self.was(node.operand, node.initially)
        return choice(operand.true, choice(matured, literal(True), was), operand)

    def elapsed(self, operand: int) -> z3.ArithRef:
        """The least time in ns for which a proposition has been true; the proposition is now
        true.
        """
        if operand not in self._elapsed:
            begun = z3.IntVal(0)
            if self._is_end:
                # If a proposition changed during the leg, its operands had all settled before.
                begun = self.leg.length_ns - self._times.settling(operand)
                begun = begun - z3.If(self.leg.is_silent, self._times.silence_ns, 0)
            if self._before is not None:
                gap = self.leg.length_ns if self._is_end else self._times.period_ns
                longer = self._before.elapsed(operand) + gap
                begun = z3.If(self._before.proposition(operand).true, longer, begun)
            self._elapsed[operand] = begun
        return self._elapsed[operand]

    def was(self, operand: int, initially: bool) -> PropositionTerm:
        """The value that a proposition had before; the proposition is now true. Before the start,
        it is `initially`.
        """
        if self._before is None:
            return literal(initially)
        before = self._before.proposition(operand)
        return choice(before.true, self._before.was(operand, initially), before)

    def remembered(self, index: int) -> PropositionTerm:
        """The value at the moment before."""
        return FALSE if self._before is None else self._before.proposition(index)

    def recurring(self, _: int, node: ir.Recurs) -> PropositionTerm:
        """True if enough of the moments so far are edges within the time."""
        near = [
            z3.If(z3.And(is_edge, since < node.window_ns), 1, 0)
            for is_edge, since in self.edges(node.operand)
        ]
        return choice(z3.Sum(near) >= node.count, literal(True), FALSE)

    def edges(self, operand: int) -> list[tuple[z3.BoolRef, z3.ArithRef]]:
        """For each moment so far, the flag that a proposition became true, and the age of the
        moment.
        """
        now = self.proposition(operand).true
        if self._before is None:
            return [(now, z3.IntVal(0))]
        gap = self.leg.length_ns if self._is_end else self._times.period_ns
        earlier = [(is_edge, since + gap) for is_edge, since in self._before.edges(operand)]
        return [*earlier, (z3.And(self._before.proposition(operand).false, now), z3.IntVal(0))]

    def oscillating(self, index: int) -> PropositionTerm:
        """The value of an oscillation that the messages of the leg give."""
        if self._is_end:
            return choice(self.leg.shakes.get(index, NO), literal(True), FALSE)
        return FALSE if self._before is None else self._before.proposition(index)


class SymbolicTrace:
    """A few legs, and the rules that are active at each of their moments. In a brief trace, each
    leg is a single message.
    """

    def __init__(
        self, asked: Questioned, propositions: Sequence[int], legs: int, *, is_brief: bool = False
    ) -> None:
        self.asked = asked
        self._is_brief = is_brief
        self.times = Times(asked, propositions)
        self.legs = [self._leg(number) for number in range(legs)]
        self.moments: list[LegMoment] = []
        for leg in self.legs:
            for is_end in (False, True):
                before = self.moments[-1] if self.moments else None
                self.moments.append(LegMoment(asked, self.times, leg, before, is_end=is_end))
        self._active: dict[tuple[int, int], z3.BoolRef] = {}

    @property
    def facts(self) -> list[z3.BoolRef]:
        """The facts of every trace. They are complete after all queries to the moments."""
        found = [fact for moment in self.moments for fact in moment.facts]
        for leg in self.legs:
            found += self._leg_facts(leg)
        if len(self.legs) > 1:  # nothing is evaluated before the first message
            found.append(z3.Or(list(self.legs[0].sends.values())))
        return found

    @property
    def calm(self) -> list[z3.BoolRef]:
        """The facts of a trace on which every sensor sends its measurements. Values that only a
        skill has are known only while the skill runs.
        """
        found = []
        machine = self.asked.machine
        for leg in self.legs:
            found += list(leg.sends.values())
            found += [
                number.known for slot, number in leg.slots.items() if not is_quantity(machine, slot)
            ]
            found += [cells[0].is_there for cells in leg.cells.values()]
        return found

    def is_active(self, rule: int, moment: int) -> z3.BoolRef:
        """S35 to S37: say whether a rule is active at a moment."""
        if moment < 0:
            return NO
        if (rule, moment) not in self._active:
            declared = self.asked.machine.rules[rule]
            condition = self.moments[moment].proposition(declared.condition)
            cleared = NO
            if declared.release is not None:
                release = self.moments[moment].proposition(declared.release)
                cleared = z3.And(condition.false, release.true)
            before = self.is_active(rule, moment - 1)
            self._active[rule, moment] = z3.If(before, z3.Not(cleared), condition.activates)
        return self._active[rule, moment]

    # --- legs --------------------------------------------------------------------------------

    def _leg(self, number: int) -> Leg:
        machine, channels = self.asked.machine, self.times.channels
        slots = {
            index: NumberTerm(z3.Bool(f"leg{number}.slot{index}.known"),
                          z3.Real(f"leg{number}.slot{index}"))
            for index, slot in enumerate(machine.slots)
            if machine.inputs[slot.input].channel in channels
        }  # fmt: skip
        cells = {
            index: self._cells(f"leg{number}.array{index}", index)
            for index, array in enumerate(machine.arrays)
            if machine.inputs[array.input].channel in channels and array.list is None
        }
        return Leg(
            {channel: z3.Bool(f"leg{number}.channel{channel}") for channel in channels},
            slots,
            cells,
            z3.Int(f"leg{number}.length"),
            {
                proposition: z3.Bool(f"leg{number}.shakes{proposition}")
                for proposition in self._shakable()
            },
            Calls(machine, f"leg{number}"),
        )

    def _cells(self, name: str, array: int) -> Sequence[Cell]:
        numbers = [
            NumberTerm(z3.BoolVal(True), z3.Real(f"{name}.{i}.value"))
            for i in range(self.asked.array_uses[array])
        ]
        return [Cell(array, z3.Bool(f"{name}.{i}"), number) for i, number in enumerate(numbers)]

    def _shakable(self) -> Iterator[int]:
        """The oscillations of values that a message carries directly."""
        machine = self.asked.machine
        for proposition in self.times.propositions:
            node = machine.propositions[proposition].node
            if not isinstance(node, ir.Oscillates):
                continue
            if isinstance(machine.signals[node.signal].node, ir.Read):
                yield proposition

    def _skill_facts(self, leg: Leg) -> list[z3.BoolRef]:
        """Facts: the answers about skills in one message are consistent, and so are the unknown
        values.
        """
        slots = self.asked.machine.slots
        asking = {index: number for index, number in leg.slots.items()
                  if query_at(slots[index].path) is not None}  # fmt: skip
        found: list[z3.BoolRef] = []
        for index, number in asking.items():
            found += leg.calls.facts(slots[index], number.value)
        known = [number.known for number in asking.values()]
        return found + [each == known[0] for each in known[1:]]

    def _leg_facts(self, leg: Leg) -> list[z3.BoolRef]:
        machine = self.asked.machine
        found = self._skill_facts(leg)
        for index, number in leg.slots.items():
            found += slot_facts(machine, machine.slots[index], number.value, rounded=False)
        found += quantity_facts(machine, leg.slots)
        for index, cells in leg.cells.items():
            found += shape_facts(cells)
            for cell in cells:
                found += limit_facts(machine.arrays[index], cell.number.value, rounded=False)
        for proposition, shakes in leg.shakes.items():
            (channel,) = self.asked.supports.propositions[proposition].channels
            found.append(z3.Implies(shakes, leg.sends[channel]))
        if self._is_brief:
            return [*found, leg.length_ns == 0]
        return [
            *found,
            leg.length_ns >= self.times.shortest_ns,
            leg.length_ns <= self.times.longest_ns + self.times.shortest_ns,
        ]
