"""Updates in columns: put together, and taken apart."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from rossmarie.ir import Batch, ChannelValues, Elements, Machine, each_update
from rossmarie.recordings.model import Update

_MOST_UPDATES = 1024
_NO_ELEMENTS: NDArray[np.generic] = np.empty(0)


class Assembly:
    """A batch of updates at some instants while it is put together."""

    def __init__(self, machine: Machine, times_ns: NDArray[np.int64]) -> None:
        count = len(times_ns)
        self._times_ns = times_ns
        self._arriving = np.zeros((count, len(machine.channels)), np.uint8)
        self._slots = np.full((count, len(machine.slots)), np.nan)
        self._arrays = [[_NO_ELEMENTS] * count for _ in machine.arrays]

    def add(
        self,
        channels: Sequence[int],
        rows: NDArray[np.intp],
        slots: Mapping[int, NDArray[np.float64]],
        arrays: Mapping[int, Sequence[NDArray[np.generic]]],
    ) -> None:
        """Messages on some channels, in some rows, and all that they carry."""
        for channel in channels:
            self._arriving[rows, channel] = 1
        for slot, column in slots.items():
            self._slots[rows, slot] = column
        for array, found in arrays.items():
            for row, elements in zip(rows.tolist(), found, strict=True):
                self._arrays[array][row] = elements

    def put(self, row: int, channel: int, values: ChannelValues) -> None:
        """One message."""
        self._arriving[row, channel] = 1
        for slot, value in values.slots.items():
            self._slots[row, slot] = value
        for array, elements in values.arrays.items():
            self._arrays[array][row] = np.array(elements, np.float64)

    def batch(self) -> Batch:
        """All of it; of what was not added, nothing is known."""
        arrays = [_joined(found) for found in self._arrays]
        return Batch(self._times_ns, self._arriving, self._slots, arrays)


def _joined(arrays: Sequence[NDArray[np.generic]]) -> Elements:
    """The arrays of all updates as one."""
    ends = np.cumsum([len(array) for array in arrays], dtype=np.int64)
    with np.errstate(invalid="ignore"):  # a NaN of any kind becomes one
        return Elements(np.concatenate([_NO_ELEMENTS, *arrays], dtype=np.float64), ends)


def batched(machine: Machine, updates: Iterable[Update]) -> Iterator[Batch]:
    """The same updates in columns, some at a time."""
    remaining = iter(updates)
    while some := list(islice(remaining, _MOST_UPDATES)):
        assembly = Assembly(machine, np.array([update.at_ns for update in some], np.int64))
        for row, update in enumerate(some):
            for channel, values in update.channels.items():
                assembly.put(row, channel, values)
        yield assembly.batch()


def updates_in(machine: Machine, batches: Iterable[Batch]) -> Iterator[Update]:
    """The updates of batches, one by one."""
    for batch in batches:
        for at_ns, messages in each_update(machine, batch):
            yield Update(at_ns, messages)
