"""Complete ROS 1 bags, with an index of their chunks."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rosbags.interfaces import Connection as RosbagsConnection

from rossmarie.recordings.bag_columns import BagChunks
from rossmarie.recordings.chunks import in_order
from rossmarie.recordings.clock import Arrivals
from rossmarie.recordings.limits import Allowance
from rossmarie.recordings.readers import open_bag_reader
from rossmarie.recordings.stored import Packed, RecordedConnection, Stored, plain_type, unpacked


class IntactBag:
    """A bag that rosbags can read, within an allowance.

    Raises one of `READER_FAILURES` if rosbags cannot read it, at construction or at any message.
    """

    def __init__(self, path: Path, allowance: Allowance) -> None:
        self._bag = open_bag_reader(path, allowance)
        self._opened = [(opened, _connection(opened)) for opened in self._bag.connections]
        self.connections = [ours for _, ours in self._opened]

    def span(self) -> tuple[int, int] | None:
        """The stamps of the first and the last message; None if there is none."""
        if self._bag.message_count == 0:
            return None
        return self._bag.start_time, self._bag.end_time - 1

    def messages(self, topics: Collection[str]) -> Iterator[Stored]:
        """The messages on some topics."""
        for batch in self.batches(topics):
            yield from unpacked(batch)

    def batches(self, topics: Collection[str]) -> Iterator[Packed]:
        """The same messages in batches."""
        chosen = [pair for pair in self._opened if pair[1].topic in topics]
        return in_order(BagChunks(self._bag, chosen)) if chosen else iter(())

    def arrivals(self) -> Iterator[Arrivals]:
        """All messages. The messages of each topic have the order in which they were stored."""
        topics = {ours.id: ours.topic for ours in self.connections}
        for position in sorted(self._bag.chunks):
            found: dict[str, list[NDArray[np.void]]] = {}
            for number, entries in self._bag.entries(position):
                if number in topics:
                    found.setdefault(topics[number], []).append(entries)
            for topic, parts in found.items():
                entries = np.concatenate(parts)
                yield topic, entries["at_ns"][np.argsort(entries["offset"], kind="stable")]

    def close(self) -> None:
        """Release the file."""
        self._bag.close()


def _connection(opened: RosbagsConnection) -> RecordedConnection:
    return RecordedConnection(
        id=opened.id,
        topic=opened.topic,
        message_type=plain_type(opened.msgtype),
        encoding="ros1",
        definition=opened.msgdef,
        count=opened.msgcount,
    )
