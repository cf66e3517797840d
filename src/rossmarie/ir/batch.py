"""Many updates in columns, and the findings of a monitor on them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from rossmarie.ir.message import ChannelValues
from rossmarie.ir.model import Array, Machine, Slot

if TYPE_CHECKING:  # NumPy is slow to import, and most commands do not need it
    import numpy as np
    from numpy.typing import NDArray

    from rossmarie.ir.verdict import Event


class ElementColumns(NamedTuple):
    """One array of all updates: update i has `values[ends[i - 1] : ends[i]]`. If `known[i]` is 0,
    update i has no such array; then a list with this column is unknown.
    """

    values: NDArray[np.float64]
    ends: NDArray[np.int64]
    known: NDArray[np.uint8]


@dataclass(frozen=True, eq=False)
class Batch:
    """Successive updates.

    `arriving` has the shape (updates, channels), with 1 if there is a message on a channel;
    `slots` has the shape (updates, slots), with NaN for unknown values; `arrays` has one entry for
    each array of the machine. Values are in the units of the messages, as in `ChannelValues`.
    """

    times_ns: NDArray[np.int64]
    arriving: NDArray[np.uint8]
    slots: NDArray[np.float64]
    arrays: Sequence[ElementColumns]


class Taken(NamedTuple):
    """The findings of a monitor in a batch: events, and samples of some signals.

    `values` has the shape (samples, signals): the values after each update, and before it if a
    timer was due. They are in SI units, and NaN where they are unknown.
    """

    events: list[Event]
    times_ns: NDArray[np.int64]
    values: NDArray[np.float64]


def each_update(machine: Machine, batch: Batch) -> Iterator[tuple[int, dict[int, ChannelValues]]]:
    """The instant of each update, and its messages by channel."""
    slots = _by_channel(machine, machine.slots)
    arrays = _by_channel(machine, machine.arrays)
    rows = zip(batch.times_ns.tolist(), batch.arriving.tolist(), batch.slots.tolist(), strict=True)
    for place, (at_ns, arriving, numbers) in enumerate(rows):
        yield (
            at_ns,
            {
                channel: ChannelValues(
                    {slot: numbers[slot] for slot in slots[channel]},
                    {
                        array: _elements(batch.arrays[array], place)
                        for array in arrays[channel]
                        if batch.arrays[array].known[place]
                    },
                )
                for channel, is_there in enumerate(arriving)
                if is_there
            },
        )


def _by_channel(machine: Machine, fields: Sequence[Slot | Array]) -> list[list[int]]:
    """The indexes of the fields that each channel carries."""
    channels = [machine.inputs[field.input].channel for field in fields]
    return [
        [index for index, carrier in enumerate(channels) if carrier == channel]
        for channel in range(len(machine.channels))
    ]


def _elements(array: ElementColumns, update: int) -> list[float]:
    start = array.ends[update - 1] if update else 0
    found: list[float] = array.values[start : array.ends[update]].tolist()
    return found
