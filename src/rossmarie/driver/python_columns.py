"""Whole columns, processed row by row by a monitor in Python. `rossmarie.native` does the same in
C.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.ir import ChannelValues, Event, FieldKind, Machine
from rossmarie.native import FLAG_VALUES, MachineColumns


@dataclass(frozen=True, eq=False)
class PythonRun:
    """The results of a run over some rows."""

    events: list[Event]
    asked_active: NDArray[np.bool_] | None

    @property
    def active(self) -> NDArray[np.bool_]:
        """The rules that were active after each row, of shape (rows, rules).

        Raises `ValueError` if the run did not record them.
        """
        if self.asked_active is None:
            raise ValueError("run with active=True to learn which rules were active")
        return self.asked_active


class PythonColumns:
    """Columns for a monitor in Python."""

    def __init__(self, machine: Machine, monitor: PythonMonitor, columns: MachineColumns) -> None:
        self._machine = machine
        self._monitor = monitor
        self._columns = columns
        self._arriving: list[int] = np.flatnonzero(columns.arriving).tolist()
        flags = np.array(FLAG_VALUES)
        self._slots = [
            flags[column] if slot.kind is FieldKind.FLAG else column
            for slot, column in zip(machine.slots, columns.slots, strict=True)
        ]

    def run(self, start: int = 0, stop: int | None = None, *, active: bool = False) -> PythonRun:
        """Process the rows from `start` up to, not including, `stop`, or to the end.

        Raises `IndexError` if there are no such rows.
        """
        rows = len(self._columns.times_ns)
        end = rows if stop is None else stop
        if not 0 <= start <= end <= rows:
            raise IndexError(f"no rows from {start} to {end} among {rows}")
        events: list[Event] = []
        states = np.zeros((end - start, len(self._machine.rules)), np.bool_)
        for row in range(start, end):
            at_ns = int(self._columns.times_ns[row])
            events += self._monitor.update(at_ns, self._messages(row))
            states[row - start] = self._monitor.active
        return PythonRun(events, states if active else None)

    def _messages(self, row: int) -> dict[int, ChannelValues]:
        """The messages of a row, by channel."""
        slots: dict[int, dict[int, float]] = {channel: {} for channel in self._arriving}
        arrays: dict[int, dict[int, list[float]]] = {channel: {} for channel in self._arriving}
        inputs = self._machine.inputs
        for index, slot in enumerate(self._machine.slots):
            slots[inputs[slot.input].channel][index] = float(self._slots[index][row])
        for index, array in enumerate(self._machine.arrays):
            arrays[inputs[array.input].channel][index] = self._columns.arrays[index][row].tolist()
        return {
            channel: ChannelValues(slots[channel], arrays[channel]) for channel in self._arriving
        }
