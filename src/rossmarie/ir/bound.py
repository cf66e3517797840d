"""Bound the evaluations that one call of a monitor can take, from the structure of its machine
alone.

Before an event, the monitor runs the wakes that fell due (S13). Each wake has an instant of its
own, at which at least one timer is due. After a jump backwards there are no wakes (S17). So there
are at most as many wakes as timers that fall due. This module counts these, with one bit for each.
The timer of an age or a timeout falls due once, and so does the window of an oscillation: only
messages start them again. The timer of `C for d` falls due at most once for each stretch in which C
is true. The first stretch may have begun before the call. Between two stretches, C ceases to be
true and becomes true again. So the timer falls due at most n + 1 times, if C becomes true n times
or ceases to be true n times, whichever is less.

The numbers of these changes are computed from left to right:

- A signal changes only to NaN, when an input in its support expires. A leaf with this signal is
  stale from then on (S30).
- `and` and `or` change only together with one of their operands.
- `C for d` becomes true when its timer falls due, and ceases to be true when C does. It becomes
  false only when C does: while C is true and the timer runs, it has the value that C had before
  (S33). It ceases to be false when its timer falls due, or when C ceases to be false or true. A
  `for` that counts as true before the start becomes true without its timer. This happens at the
  first event, before which no timer falls due.
- `A since B` becomes true or ceases to be false only when B does, because otherwise it keeps its
  last value. It ceases to be true or becomes false only when A or B does (S44).
- The edges of C within d become enough only at an edge, where C becomes true and ceases to be
  false. They cease to be enough when the window of an edge ends: of an edge that counts now, or
  of an edge during the call. A value that is unknown after a gap is known again one window later;
  a gap ends where C becomes true or false.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import reduce
from operator import or_

from rossmarie.ir import model as ir
from rossmarie.ir.support import proposition_operands, supports


def most_evaluations(machine: ir.Machine) -> int:
    """A bound on the evaluations of one call, including the event itself.

    The function takes time and memory in proportion to the bound. Call it only for machines that
    `MOST_EVALUATIONS` does not rule out.
    """
    return 1 + sum(count for _, count in wakes(machine))


def wakes(machine: ir.Machine) -> Iterator[tuple[ir.Input | ir.Proposition, int]]:
    """The evaluations that each input and each proposition adds, from left to right. This is the
    number of times that its timer falls due in one call. It is 0 if there is no timer, or if an
    earlier input or proposition has the same timer.
    """
    counted = _Counted(machine)
    for declared in machine.inputs:
        before = counted.total
        counted.expiry(declared)
        yield declared, counted.total - before
    for index, proposition in enumerate(machine.propositions):
        before = counted.total
        counted.add(index)
        yield proposition, counted.total - before


@dataclass(frozen=True)
class _Changes:
    """The evaluations at which a proposition can change, as the bits of integers."""

    becomes_true: int = 0
    ceases_true: int = 0
    becomes_false: int = 0
    ceases_false: int = 0

    def negated(self) -> _Changes:
        return _Changes(self.becomes_false, self.ceases_false, self.becomes_true, self.ceases_true)

    def __or__(self, other: _Changes) -> _Changes:
        return _Changes(
            self.becomes_true | other.becomes_true,
            self.ceases_true | other.ceases_true,
            self.becomes_false | other.becomes_false,
            self.ceases_false | other.ceases_false,
        )


class _Counted:
    """The evaluations counted so far, and the possible changes of each proposition at them."""

    def __init__(self, machine: ir.Machine) -> None:
        self.total = 0
        self._machine = machine
        self._supports = supports(machine).propositions
        self._changes: list[_Changes] = []
        self._ages: dict[tuple[int, int], int] = {}

    def expiry(self, declared: ir.Input) -> int:
        """The evaluation at which an input expires, as a bit; 0 if the input never expires."""
        if declared.timeout_ns is None:
            return 0
        return self._age(declared.channel, declared.timeout_ns)

    def add(self, index: int) -> None:
        """Count the next proposition."""
        self._changes.append(self._found(index, self._machine.propositions[index].node))

    def _found(self, index: int, node: ir.PropositionNode) -> _Changes:
        operands = [self._changes[operand] for operand in proposition_operands(node)]
        match node:
            case ir.And() | ir.Or():
                return reduce(or_, operands)
            case ir.Not():
                return operands[0].negated()
            case ir.Held():
                return self._held(operands[0])
            case ir.Since():
                return _since(*operands)
            case ir.Recurs():
                return self._recurs(operands[0])
            case ir.AgeReaches(input=used, age_ns=age_ns):
                due = self._age(self._machine.inputs[used].channel, age_ns)
                return _Changes(becomes_true=due, ceases_false=due)
            case ir.Oscillates():
                closes = self._new(1)
                return self._stale(index) | _Changes(ceases_true=closes, becomes_false=closes)
            case ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.Quantified():
                return self._stale(index)

    def _held(self, operand: _Changes) -> _Changes:
        again = min(operand.becomes_true.bit_count(), operand.ceases_true.bit_count())
        matures = self._new(1 + again)
        return _Changes(
            becomes_true=matures,
            ceases_true=operand.ceases_true,
            becomes_false=operand.becomes_false,
            ceases_false=matures | operand.ceases_false | operand.ceases_true,
        )

    def _recurs(self, operand: _Changes) -> _Changes:
        edges = min(operand.becomes_true.bit_count(), operand.ceases_false.bit_count())
        gaps = (operand.becomes_true | operand.becomes_false).bit_count()
        closes = self._new(2 + edges + gaps)
        return _Changes(
            becomes_true=operand.becomes_true,
            ceases_true=closes,
            becomes_false=closes,
            ceases_false=operand.ceases_true | operand.ceases_false,
        )

    def _stale(self, index: int) -> _Changes:
        """The evaluations at which a leaf becomes stale: when one of its inputs expires."""
        inputs = (self._machine.inputs[used] for used in self._supports[index].inputs)
        expires = reduce(or_, map(self.expiry, inputs), 0)
        return _Changes(ceases_true=expires, ceases_false=expires)

    def _age(self, channel: int, age_ns: int) -> int:
        """The evaluation for an age. Inputs of one channel reach an age at the same instant."""
        if (channel, age_ns) not in self._ages:
            self._ages[channel, age_ns] = self._new(1)
        return self._ages[channel, age_ns]

    def _new(self, count: int) -> int:
        """Bits for `count` more evaluations."""
        new = ((1 << count) - 1) << self.total
        self.total += count
        return new


def _since(held: _Changes, begun: _Changes) -> _Changes:
    return _Changes(
        becomes_true=begun.becomes_true,
        ceases_true=held.ceases_true | begun.ceases_true,
        becomes_false=held.becomes_false | begun.becomes_false,
        ceases_false=begun.ceases_false,
    )
