"""Any state at any evaluation of a closed loop: the same messages arrive from outside, and the
topics on which rules publish carry only the messages of these rules.

This state covers too many cases, like `ArbitraryState`, on which it is based.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import z3

from rossmarie.analysis.encoding import Questioned
from rossmarie.analysis.state import ArbitraryState
from rossmarie.analysis.terms import YES, NumberTerm, constant, constants_in, within
from rossmarie.ir.carried import si_ends

Ends = tuple[float, float]
"""The least and the greatest raw number that a slot of a message may hold; NaN if the slot holds no
number.
"""


@dataclass(frozen=True)
class Carried:
    """The arrivals on a channel: messages that rules publish, each with its slots. If the channel
    is open, a message from outside arrives as well, which a filter may move closer to 0.
    """

    messages: Sequence[Mapping[int, Ends]]
    is_open: bool


Published = Mapping[int, Carried]
"""The channels on which rules publish."""

_OUTSIDE = ".outside"


class ClosedState(ArbitraryState):
    """A state in which the last message on some channels comes from a rule."""

    def __init__(self, asked: Questioned, published: Published) -> None:
        super().__init__(asked)
        self._published = published

    def slot(self, index: int) -> NumberTerm:
        """The number in a slot of a message, which comes from a rule or from outside."""
        is_new = index not in self._slots
        number = super().slot(index)
        used = self.machine.slots[index].input
        channel = self.machine.inputs[used].channel
        if is_new and channel in self._published:
            self.facts += self._carried(index, channel, number, self.is_fresh(used))
        return number

    def _carried(
        self, index: int, channel: int, number: NumberTerm, fresh: z3.BoolRef
    ) -> Iterator[z3.BoolRef]:
        """Facts: a slot belongs to the message that arrived last, and this message is the same for
        all slots.
        """
        slot, carried = self.machine.slots[index], self._published[channel]
        message = z3.Int(f"channel{channel}.message")
        count = len(carried.messages)
        yield z3.And(message >= 0, message < count + carried.is_open)
        for place, ends in enumerate(each[index] for each in carried.messages):
            if any(map(math.isnan, ends)):
                yield z3.Implies(message == place, z3.Not(number.known))
                continue
            is_within = z3.And(within(number.value, si_ends(slot, ends)))
            yield z3.Implies(message == place, z3.And(number.known == fresh, is_within))
        sent, zero = z3.Real(f"slot{index}{_OUTSIDE}"), constant(slot.offset)
        above = z3.And(zero <= number.value, number.value <= sent)
        below = z3.And(sent <= number.value, number.value <= zero)
        yield z3.Implies(message == count, z3.Or(above, below))

    def has_arrived(self, channel: int) -> z3.BoolRef:
        """Say whether a message has arrived. Messages of rules have. Messages from outside may have
        arrived; the answer is the same at all moments.
        """
        carried = self._published.get(channel)
        if carried is not None and not carried.is_open:
            return YES
        return super().has_arrived(channel)

    def age(self, channel: int) -> z3.ArithRef:
        """The age of the last message. Messages from outside come often enough."""
        is_new = channel not in self._ages
        found = super().age(channel)
        if is_new and channel not in self._published:
            timeouts = [used.timeout_ns for used in self.machine.inputs if used.channel == channel]
            self.facts += [found < each for each in timeouts if each is not None]
        return found

    def at(self, moment: int, predicate: z3.BoolRef) -> z3.BoolRef:
        """A predicate, evaluated in a similar state at one moment. Messages from outside are the
        same at all moments; all other variables belong to this moment.
        """
        term, shared = z3.And(*self.facts, predicate), self._shared
        constants = {each.decl().name(): each for each in constants_in(term)}
        own = [
            (each, z3.Const(f"{name}@{moment}", each.sort()))
            for name, each in constants.items()
            if name not in shared and not name.endswith(_OUTSIDE)
        ]
        return z3.substitute(term, *own)

    @property
    def _shared(self) -> set[str]:
        """The names of the variables for outside messages: the arrivals and their numbers."""
        outside = {
            index
            for index in self._slots
            if self.machine.inputs[self.machine.slots[index].input].channel not in self._published
        }
        numbers = [self._slots[index] for index in outside]
        names = {number.value.decl().name() for number in numbers}
        names |= {number.known.decl().name() for number in numbers}
        for channel in range(len(self.machine.channels)):
            arrived = self.has_arrived(channel)
            names |= {each.decl().name() for each in constants_in(arrived)}
        return names
