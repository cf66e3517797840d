"""The stored messages of a recording, still as bytes.

`IntactStorage` reads complete files with rosbags. The salvage modules read the rest of damaged
files.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import chain
from pathlib import Path
from typing import Protocol

from rosbags.interfaces import Connection as RosbagsConnection
from rosbags.interfaces import ConnectionExtRosbag2
from rosbags.rosbag2.storage_mcap import McapReader
from rosbags.rosbag2.storage_sqlite3 import Sqlite3Reader

from rossmarie.recordings.arrivals import records_in_order, rows_in_order
from rossmarie.recordings.chunks import in_order
from rossmarie.recordings.clock import Arrivals
from rossmarie.recordings.compression import decompress
from rossmarie.recordings.limits import Allowance
from rossmarie.recordings.mcap_columns import McapChunks, has_chunks
from rossmarie.recordings.readers import open_ros2_reader, parts_of
from rossmarie.recordings.stored import Packed, RecordedConnection, Stored, packed, plain_type


class Storage(Protocol):
    """Stored messages, in the order of their stamps."""

    @property
    def connections(self) -> Sequence[RecordedConnection]:
        """The sources of messages. Several sources may send on one topic."""

    def span(self) -> tuple[int, int] | None:
        """The stamps of the first and the last message; None if there is none."""

    def messages(self, topics: Collection[str]) -> Iterator[Stored]:
        """The messages on some topics."""

    def batches(self, topics: Collection[str]) -> Iterator[Packed]:
        """The same messages in batches."""

    def arrivals(self) -> Iterator[Arrivals]:
        """All messages. The messages of each topic have the order in which they were stored."""

    def close(self) -> None:
        """Release the file."""


class SalvageableStorage(Storage, Protocol):
    """The readable rest of a damaged file."""

    @property
    def loss(self) -> str | None:
        """The loss, in words; None if nothing is missing."""


class IntactStorage:
    """A file of ROS 2, or a bag directory, that rosbags can read, within an allowance.

    Raises one of `READER_FAILURES` if rosbags cannot read it, at construction or at any message.
    """

    def __init__(self, path: Path, allowance: Allowance) -> None:
        self._allowance = allowance
        self._reader, self._is_packed = open_ros2_reader(path, allowance)
        self._opened = list(self._reader.connections)
        self.connections = [_connection(opened) for opened in self._opened]

    def span(self) -> tuple[int, int] | None:
        """The stamps of the first and the last message; None if there is none."""
        if self._reader.message_count == 0:
            return None
        return self._reader.start_time, self._reader.end_time - 1

    def messages(self, topics: Collection[str]) -> Iterator[Stored]:
        """The messages on some topics."""
        chosen = [opened for opened in self._opened if opened.topic in topics]
        if not chosen:
            return
        ours = {opened.id: _connection(opened) for opened in chosen}
        for opened, at_ns, content in self._reader.messages(chosen):
            if self._is_packed:
                content = decompress("zstd", content, self._allowance)
            yield Stored(ours[opened.id], at_ns, content)

    def batches(self, topics: Collection[str]) -> Iterator[Packed]:
        """The same messages in batches."""
        parts = parts_of(self._reader)
        if self._is_packed or not all(map(has_chunks, parts)):
            return packed(self.messages(topics))
        chosen = [opened for opened in self._opened if opened.topic in topics]
        chunks = (McapChunks(part, _asked(part, chosen)) for part in parts)
        return chain.from_iterable(map(in_order, chunks))

    def arrivals(self) -> Iterator[Arrivals]:
        """All messages. The messages of each topic have the order in which they were stored."""
        for part in parts_of(self._reader):
            if isinstance(part, Sqlite3Reader):
                yield from rows_in_order(Path(str(part.path)))
            elif isinstance(part, McapReader):
                topics = {opened.id: opened.topic for opened in part.connections}
                yield from records_in_order(Path(str(part.path)), topics, self._allowance)

    def close(self) -> None:
        """Release the file."""
        self._reader.close()


def _asked(
    part: McapReader, chosen: Sequence[RosbagsConnection]
) -> list[tuple[RosbagsConnection, RecordedConnection]]:
    """The chosen connections in one of the files, in the forms of rosbags and of this package."""
    found = []
    for opened in part.connections:
        same = next((each for each in chosen if _is_same(opened, each)), None)
        if same is not None:
            found.append((opened, _connection(same)))
    return found


def _is_same(one: RosbagsConnection, other: RosbagsConnection) -> bool:
    """Say whether two connections in different files are equal for rosbags."""
    if (one.topic, one.msgtype, one.ext) != (other.topic, other.msgtype, other.ext):
        return False
    return not (one.digest and other.digest) or one.digest == other.digest


def _connection(opened: RosbagsConnection) -> RecordedConnection:
    ext = opened.ext
    assert isinstance(ext, ConnectionExtRosbag2), "a reader of ROS 2 opened it"
    return RecordedConnection(
        id=opened.id,
        topic=opened.topic,
        message_type=plain_type(opened.msgtype),
        encoding=ext.serialization_format,
        definition=opened.msgdef,
        count=opened.msgcount,
    )
