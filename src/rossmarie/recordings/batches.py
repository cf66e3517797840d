"""Updates in columns: their assembly, and their separation."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from rossmarie.ir import Batch, ChannelValues, ElementColumns, Machine, columns_of, each_update
from rossmarie.recordings.model import Update

_MOST_UPDATES = 1024
_NO_ELEMENTS: NDArray[np.generic] = np.empty(0)


class Assembly:
    """A batch of updates at some instants during assembly."""

    def __init__(self, machine: Machine, times_ns: NDArray[np.int64]) -> None:
        count = len(times_ns)
        self._times_ns = times_ns
        self._arriving = np.zeros((count, len(machine.channels)), np.uint8)
        self._slots = np.full((count, len(machine.slots)), np.nan)
        self._arrays: list[list[NDArray[np.generic] | None]] = [
            [_NO_ELEMENTS if array.list is None else None] * count for array in machine.arrays
        ]
        self._lists = [
            (columns_of(machine, index), each.most) for index, each in enumerate(machine.lists)
        ]

    def add(
        self,
        channels: Sequence[int],
        rows: NDArray[np.intp],
        slots: Mapping[int, NDArray[np.float64]],
        arrays: Mapping[int, Sequence[NDArray[np.generic] | None]],
    ) -> None:
        """Add messages on some channels, in some rows, with all known values."""
        for channel in channels:
            self._arriving[rows, channel] = 1
        for slot, column in slots.items():
            self._slots[rows, slot] = column
        for array, found in arrays.items():
            for row, elements in zip(rows.tolist(), found, strict=True):
                if elements is not None:
                    self._arrays[array][row] = elements

    def put(self, row: int, channel: int, values: ChannelValues) -> None:
        """Set the values of one message."""
        self._arriving[row, channel] = 1
        for slot, value in values.slots.items():
            self._slots[row, slot] = value
        for array, elements in values.arrays.items():
            self._arrays[array][row] = np.array(elements, np.float64)

    def _look_at_list(self, columns: Sequence[int], most: int, row: int) -> None:
        """S51: an incomplete or too long list is unknown."""
        found = [self._arrays[column][row] for column in columns]
        counts = {None if each is None else len(each) for each in found}
        (count,) = counts if len(counts) == 1 else (None,)
        if count is None or count > most:
            for column in columns:
                self._arrays[column][row] = None

    def batch(self) -> Batch:
        """The whole batch, without rows in which no message arrived. Values that were not added are
        unknown.
        """
        for columns, most in self._lists:
            for row in range(len(self._times_ns)):
                self._look_at_list(columns, most, row)
        rows = np.flatnonzero(
            self._arriving.any(axis=1)
        )  # the other messages contained no value that is read
        arrays = [_joined([found[row] for row in rows.tolist()]) for found in self._arrays]
        return Batch(self._times_ns[rows], self._arriving[rows], self._slots[rows], arrays)


def _joined(arrays: Sequence[NDArray[np.generic] | None]) -> ElementColumns:
    """The arrays of all updates as one."""
    found = [_NO_ELEMENTS if array is None else array for array in arrays]
    ends = np.cumsum([len(array) for array in found], dtype=np.int64)
    known = np.array([array is not None for array in arrays], np.uint8)
    with np.errstate(invalid="ignore"):  # all kinds of NaN become the same NaN
        values = np.concatenate([_NO_ELEMENTS, *found], dtype=np.float64)
    return ElementColumns(values, ends, known)


def batched(machine: Machine, updates: Iterable[Update]) -> Iterator[Batch]:
    """Updates in columns, several in each batch."""
    remaining = iter(updates)
    while some := list(islice(remaining, _MOST_UPDATES)):
        assembly = Assembly(machine, np.array([update.at_ns for update in some], np.int64))
        for row, update in enumerate(some):
            for channel, values in update.channels.items():
                assembly.put(row, channel, values)
        yield assembly.batch()


def begun_together(machine: Machine, batches: Iterable[Batch]) -> Iterator[Batch]:
    """The same batches with one update for all messages of the first instant, because a node also
    begins with the first messages of all topics together. If a topic has another message at that
    instant, that message and later messages are separate updates.
    """
    remaining = iter(batches)
    begun, times_ns = list[Batch](), list[int]()
    for batch in remaining:
        begun.append(batch)
        times_ns += batch.times_ns.tolist()
        if times_ns and times_ns[-1] != times_ns[0]:
            break
    if len(times_ns) > 1 and times_ns[0] == times_ns[1]:
        yield from batched(machine, _merged(list(updates_in(machine, begun))))
    else:
        yield from begun
    yield from remaining


def _merged(updates: Sequence[Update]) -> list[Update]:
    """The same updates; the first updates are merged into one."""
    together = dict(updates[0].channels)
    for count, update in enumerate(updates):
        is_new = count == 0 or together.keys().isdisjoint(update.channels)
        if update.at_ns != updates[0].at_ns or not is_new:
            return [Update(updates[0].at_ns, together), *updates[count:]]
        together |= update.channels
    return [Update(updates[0].at_ns, together)]


def updates_in(machine: Machine, batches: Iterable[Batch]) -> Iterator[Update]:
    """The updates of batches, one by one."""
    for batch in batches:
        for at_ns, messages in each_update(machine, batch):
            yield Update(at_ns, messages)
