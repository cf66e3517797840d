"""The chunks of a ROS 1 bag.

If a record is malformed, rosbags reads the batch instead and reports the reason.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from rosbags.interfaces import Connection as RosbagsConnection
from rosbags.rosbag1.reader import IndexData, read_bytes

from rossmarie.recordings.bag_index import IndexedBag
from rossmarie.recordings.bag_records import message_places
from rossmarie.recordings.chunks import ROW, Contents, Places, Rows, pack
from rossmarie.recordings.stored import READER_FAILURES, Packed, RecordedConnection, Stored, packed


class BagChunks:
    """The chunks of an open bag, by their place in its index. `asked` are the connections with the
    requested messages, in the forms of rosbags and of this package.
    """

    def __init__(
        self, bag: IndexedBag, asked: Sequence[tuple[RosbagsConnection, RecordedConnection]]
    ) -> None:
        self._bag = bag
        self._opened = [opened for opened, _ in asked]
        self._connections = [ours for _, ours in asked]
        self._senders = {opened.id: sender for sender, opened in enumerate(self._opened)}
        self._numbers = np.array([opened.id for opened in self._opened], np.int64)
        self._positions = [info.pos for info in bag.chunk_infos]
        self._contents = Contents(self._load)

    @property
    def starts_ns(self) -> Mapping[int, int]:
        """See `Chunks.starts_ns`."""
        spans = self._bag.spans
        chunks = enumerate(self._positions)
        return {chunk: spans[position][0] for chunk, position in chunks if position in spans}

    def rows(self, chunk: int) -> Rows:
        """See `Chunks.rows`. The rows come from the index."""
        position = self._positions[chunk]
        records = list(self._bag.entries(position))
        offsets = np.sort(np.concatenate([entries["offset"] for _, entries in records]))
        ends = np.append(offsets, self._bag.sizes[position])
        found = [np.empty(0, ROW)]
        for number, entries in records:
            if number in self._senders:
                rows = np.empty(len(entries), ROW)
                rows["at_ns"], rows["offset"] = entries["at_ns"], entries["offset"]
                rows["rank"] = rows["sender"] = self._senders[number]
                after = np.searchsorted(offsets, entries["offset"], side="right")
                rows["size"] = ends[after] - entries["offset"]
                found.append(rows)
        rows = np.concatenate(found)
        rows["chunk"], rows["place"] = chunk, np.arange(len(rows))
        return rows

    def batches(self, rows: Rows) -> Iterator[Packed]:
        """See `Chunks.batches`."""
        try:
            batch = pack(rows, self._connections, self._contents, self._find)
        except READER_FAILURES:
            yield from packed(self._by_rosbags(rows))
        else:
            yield batch

    def _find(self, content: bytes, rows: Rows) -> Places:
        numbers = self._numbers[rows["sender"]]
        return message_places(content, rows["offset"], numbers, rows["at_ns"])

    def _load(self, chunk: int) -> bytes:
        assert self._bag.bio is not None, "the bag is open"
        head = self._bag.chunks[self._positions[chunk]]
        self._bag.bio.seek(head.datapos)
        return head.decompressor(read_bytes(self._bag.bio, head.datasize))

    def _by_rosbags(self, rows: Rows) -> Iterator[Stored]:
        """The messages one by one. Raises one of `READER_FAILURES`."""
        indexes: dict[int, list[IndexData]] = {opened.id: [] for opened in self._opened}
        columns = (rows[name].tolist() for name in ("sender", "at_ns", "chunk", "offset"))
        for sender, at_ns, chunk, offset in zip(*columns, strict=True):
            entry = IndexData(at_ns, self._positions[chunk], offset)
            indexes[self._opened[sender].id].append(entry)
        self._bag.indexes = indexes
        for opened, at_ns, content in self._bag.messages(self._opened):
            yield Stored(self._connections[self._senders[opened.id]], at_ns, content)
