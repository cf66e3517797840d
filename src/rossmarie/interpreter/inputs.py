"""Arriving messages, and inputs that become stale (rules S7 to S10 and S17)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rossmarie import ir
from rossmarie.interpreter.arithmetic import NAN, finite_or_nan
from rossmarie.interpreter.memory import MachineMemory
from rossmarie.ir import ChannelValues, InputState


class InputUpdater:
    """Keeps the slots, arrays and input states in memory up to date."""

    def __init__(self, machine: ir.Machine, memory: MachineMemory) -> None:
        self._machine = machine
        self._memory = memory
        self._columns = [ir.columns_of(machine, each) for each in range(len(machine.lists))]

    def receive(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> None:
        """Process messages at an instant, by channel index."""
        for index, declared in enumerate(self._machine.inputs):
            if declared.channel in messages:
                self._memory.inputs[index].state = InputState.FRESH
                self._memory.inputs[index].stamp_ns = at_ns
        for index, slot in enumerate(self._machine.slots):
            if (values := messages.get(self._channel(slot.input))) is not None:
                raw = values.slots.get(index, NAN)
                # S7: a number that is not finite is not a measurement.
                self._memory.slots[index] = finite_or_nan(_convert(raw, slot))
        for index, array in enumerate(self._machine.arrays):
            if (values := messages.get(self._channel(array.input))) is not None:
                # S8: an infinite element is an ordinary number ("out of range", REP 117).
                elements = self._arrived(index, array, values)
                if elements is not None:
                    elements = [_convert(raw, array) for raw in elements]
                self._memory.arrays[index] = elements

    def expire(self, at_ns: int) -> frozenset[int]:
        """S10: the inputs that reach their timeout. Their values are forgotten."""
        expired = frozenset(
            index for index in range(len(self._machine.inputs)) if self._is_due(index, at_ns)
        )
        for index in expired:
            self._memory.inputs[index].state = InputState.EXPIRED
        for index, slot in enumerate(self._machine.slots):
            if slot.input in expired:
                self._memory.slots[index] = NAN
        for index, array in enumerate(self._machine.arrays):
            if array.input in expired:
                self._memory.arrays[index] = None
        return expired

    def _arrived(
        self, index: int, array: ir.Array, values: ChannelValues
    ) -> Sequence[float] | None:
        """The elements of an array in a message. None if the array was not observed: an array
        without elements (S24), or an unknown list (S51).
        """
        if array.list is None:
            return values.arrays.get(index) or None
        columns, most = self._columns[array.list], self._machine.lists[array.list].most
        return None if ir.known_count(values, columns, most) is None else values.arrays[index]

    def restart(self, at_ns: int) -> None:
        """S17: after a jump, every input is as old as before. No limit of an age is above
        `LONGEST_NS`, so the ages of older inputs are set to `LONGEST_NS`.
        """
        now_ns = self._memory.now_ns
        assert now_ns is not None, "only a clock that ran can jump"
        for present in self._memory.inputs:
            present.stamp_ns = at_ns - min(now_ns - present.stamp_ns, ir.LONGEST_NS)

    def _is_due(self, index: int, at_ns: int) -> bool:
        timeout_ns = self._machine.inputs[index].timeout_ns
        present = self._memory.inputs[index]
        if timeout_ns is None or present.state is not InputState.FRESH:
            return False
        return at_ns - present.stamp_ns >= timeout_ns

    def _channel(self, index: int) -> int:
        return self._machine.inputs[index].channel


def _convert(raw: float, source: ir.Slot | ir.Array) -> float:
    """S7: from the unit of the message to SI."""
    if source.scale == 1.0 and source.offset == 0.0:
        return raw
    return raw * source.scale + source.offset
