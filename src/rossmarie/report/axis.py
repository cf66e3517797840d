"""The axis of a replay: nanoseconds since its start, on which time never runs backwards.

If the stamps of a recording jump back (a reset simulation, a set clock), the axis continues from
its last position. Without jumps, a position is the stamp minus the start.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rossmarie.ir import Event, TimeJump


@dataclass(frozen=True)
class PlacedEvent:
    """An event and its position on the axis, in ns.

    `origin_ns` is the origin of the stamps since the last jump: the position of such a stamp is the
    stamp minus the origin.
    """

    event: Event
    position_ns: int
    origin_ns: int

    @property
    def at_ns(self) -> int:
        """The stamp of the event."""
        return self.position_ns + self.origin_ns


def place(events: Iterable[Event], start_ns: int) -> Iterator[PlacedEvent]:
    """The events in their order, each with its position. A jump has the position at which it
    ends.
    """
    origin = start_ns
    for event in events:
        if isinstance(event, TimeJump):
            origin -= event.from_ns - event.to_ns
            stamp = event.to_ns
        else:
            stamp = event.at_ns
        yield PlacedEvent(event, stamp - origin, origin)


class Axis:
    """Computes the positions of stamps, block by block."""

    def __init__(self) -> None:
        self._first: int | None = None
        self._last = 0
        self._repeated = 0

    def place(self, stamps_ns: NDArray[np.int64]) -> NDArray[np.int64]:
        """The positions of the next stamps of a monitor's input, in ns since the very first stamp.

        Pass all stamps: jumps are detected only from the stamps.
        """
        if len(stamps_ns) == 0:
            return stamps_ns
        if self._first is None:
            self._first = self._last = int(stamps_ns[0])
        steps = np.diff(stamps_ns, prepend=self._last)
        repeated = self._repeated + np.cumsum(np.where(steps < 0, -steps, 0))
        self._last, self._repeated = int(stamps_ns[-1]), int(repeated[-1])
        return np.asarray(stamps_ns - self._first + repeated, dtype=np.int64)
