"""A monitor under test on a machine written down by hand, in seconds and messages by channel."""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie.interpreter import Interpreter
from rossmarie.ir import Change, ChannelValues, Event, TruthValue, Verdict, verify
from support.drafts import SECOND, Draft

Value = float | Sequence[float]


class Bench:
    """A monitor under test. Slots and arrays are fed by channel, instants are in seconds."""

    def __init__(self, draft: Draft) -> None:
        machine = draft.machine()
        verify(machine)
        self.machine = machine
        self.monitor = Interpreter(machine)

    def send(self, seconds: float, **values: Value) -> list[Event]:
        """Messages by channel, `c0=3.0` or `c0=[1.0, 2.0]`."""
        messages = {int(name[1:]): self._message(int(name[1:]), v) for name, v in values.items()}
        return self.monitor.update(ns(seconds), messages)

    def _message(self, channel: int, value: Value) -> ChannelValues:
        def belongs(index: int) -> bool:
            return self.machine.inputs[index].channel == channel

        if isinstance(value, float):
            slots = [i for i, slot in enumerate(self.machine.slots) if belongs(slot.input)]
            return ChannelValues(slots=dict.fromkeys(slots, value))
        arrays = [i for i, array in enumerate(self.machine.arrays) if belongs(array.input)]
        return ChannelValues(arrays=dict.fromkeys(arrays, value))

    def advance(self, seconds: float) -> list[Event]:
        return self.monitor.advance(ns(seconds))

    def reset(self, seconds: float, rule: int | None = None) -> list[Event]:
        return self.monitor.reset(ns(seconds), rule)

    def wake(self) -> float | None:
        wake_ns = self.monitor.next_wake()
        return None if wake_ns is None else wake_ns / SECOND

    def proposition(self, index: int) -> TruthValue | None:
        return self.monitor._memory.truth_values[index]

    def signal(self, index: int) -> float:
        return self.monitor._memory.signals[index]


def ns(seconds: float) -> int:
    return round(seconds * SECOND)


def reported(events: Sequence[Event]) -> list[tuple[int, float, Change]]:
    """Rule, instant in seconds and change of the verdicts."""
    return [
        (event.rule, event.at_ns / SECOND, event.change)
        for event in events
        if isinstance(event, Verdict)
    ]
