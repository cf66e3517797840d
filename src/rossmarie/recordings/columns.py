"""What passes from a recording to a monitor, kept as columns: for plots, and for whole-columns
runs.
"""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING

from rossmarie.ir import Machine
from rossmarie.recordings.model import Update

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Column:
    """The values of one slot, in the unit of its messages, and the instants of the messages.

    Both have the shape (number of messages on the channel of the slot,).
    """

    times_ns: NDArray[np.int64]
    values: NDArray[np.float64]


class Columns:
    """Keeps the slots of all updates that pass through `keep`. Arrays are not kept."""

    def __init__(self, machine: Machine) -> None:
        self._channel_of = [machine.inputs[slot.input].channel for slot in machine.slots]
        self._times = [array("q") for _ in machine.channels]
        self._values = [array("d") for _ in machine.slots]
        self._slots_of = [
            [slot for slot, owner in enumerate(self._channel_of) if owner == channel]
            for channel in range(len(machine.channels))
        ]

    def keep(self, updates: Iterable[Update]) -> Iterator[Update]:
        """The same updates; each one is kept before it is handed on."""
        for update in updates:
            for channel, values in update.channels.items():
                self._times[channel].append(update.at_ns)
                for slot in self._slots_of[channel]:
                    self._values[slot].append(values.slots.get(slot, nan))
            yield update

    def slot(self, index: int) -> Column:
        """What has been kept of a slot so far."""
        import numpy as np  # slow to import, and not needed before there is something to plot

        times = np.array(self._times[self._channel_of[index]], dtype=np.int64)
        return Column(times, np.array(self._values[index], dtype=np.float64))
