"""The axis of a replay: nanoseconds or seconds since its start, on which time never runs backwards.

Where the stamps of a recording jump back (a simulation that was reset, a clock that was set), the
axis goes on from where it was. Without jumps a position is just the stamp less the start.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rossmarie.ir import Event, TimeJump


@dataclass(frozen=True)
class PlacedEvent:
    """An event and its position on the axis, in nanoseconds.

    `origin_ns` is the stamp that the axis begins with as seen from here: the position of any stamp
    since the last jump is the stamp less the origin.
    """

    event: Event
    position_ns: int
    origin_ns: int

    @property
    def at_ns(self) -> int:
        """The stamp of the event."""
        return self.position_ns + self.origin_ns


def place(events: Iterable[Event], start_ns: int) -> Iterator[PlacedEvent]:
    """The events in their order, each with its position; a jump lies where it ends."""
    origin = start_ns
    for event in events:
        if isinstance(event, TimeJump):
            origin -= event.from_ns - event.to_ns
            stamp = event.to_ns
        else:
            stamp = event.at_ns
        yield PlacedEvent(event, stamp - origin, origin)


def axis_seconds(stamps_ns: NDArray[np.int64], start_ns: int) -> NDArray[np.float64]:
    """The positions, in seconds, of all stamps that a monitor was fed with, in that order.

    The stamps must be complete: a jump back is seen in them, and only in them.
    """
    steps = np.diff(stamps_ns, prepend=stamps_ns[:1])
    repeated = np.cumsum(np.where(steps < 0, -steps, 0))
    return np.asarray((stamps_ns - start_ns + repeated) / 1e9, dtype=np.float64)
