"""The stored messages of a recording, still as bytes.

`IntactStorage` reads files as they should be, by way of rosbags; the salvage modules read what is
left of damaged ones.
"""

from __future__ import annotations

import struct
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, Protocol

import apsw
from rosbags import rosbag1, rosbag2
from rosbags.interfaces import Connection as RosbagsConnection
from rosbags.interfaces import ConnectionExtRosbag2, MessageDefinition
from rosbags.rosbag2.storage_mcap import McapReader
from rosbags.rosbag2.storage_sqlite3 import Sqlite3Reader

from rossmarie.recordings.arrivals import records_in_order, rows_in_order
from rossmarie.recordings.clock import Arrival
from rossmarie.recordings.compression import DECOMPRESSION_FAILURES, decompress
from rossmarie.recordings.limits import Allowance
from rossmarie.recordings.readers import open_bag_reader, open_ros2_reader, parts_of

READER_FAILURES: tuple[type[Exception], ...] = (
    rosbag1.ReaderError,
    rosbag2.ReaderError,
    *DECOMPRESSION_FAILURES,
    apsw.Error,
    struct.error,
    ArithmeticError,
    AssertionError,
    AttributeError,
    LookupError,
    MemoryError,
    OSError,
    TypeError,
    ValueError,
)
"""What rosbags raises on damaged files: it takes much of their content for granted, so that a byte
that is wrong shows up as whatever Python makes of it.
"""


@dataclass(frozen=True)
class Connection:
    """One source of messages on a topic; `id` is its number in the file.

    `message_type` is `sensor_msgs/Imu`, `encoding` is `ros1`, `cdr`, or one that cannot be decoded
    here. `definition` may be empty.
    """

    id: int
    topic: str
    message_type: str
    encoding: str
    definition: MessageDefinition
    count: int


class Stored(NamedTuple):
    """One message as it is stored."""

    connection: Connection
    at_ns: int
    content: bytes


class Storage(Protocol):
    """Stored messages, in the order of their stamps."""

    @property
    def connections(self) -> Sequence[Connection]:
        """Where messages come from; several may send on one topic."""

    def span(self) -> tuple[int, int] | None:
        """The stamps of the first and the last message; None if there is none."""

    def messages(self, topics: Collection[str]) -> Iterator[Stored]:
        """The messages on some topics."""

    def arrivals(self) -> Iterator[Arrival]:
        """All messages, in the order in which they were stored."""

    def close(self) -> None:
        """Release the file."""


class SalvageableStorage(Storage, Protocol):
    """What is left of a damaged file."""

    @property
    def loss(self) -> str | None:
        """What is missing, in words; None if nothing is."""


def plain_type(name: str) -> str:
    """`sensor_msgs/Imu` for `sensor_msgs/msg/Imu`; other kinds of interfaces keep their name."""
    return name.replace("/msg/", "/", 1)


class IntactStorage:
    """A file or bag directory that rosbags can read, within an allowance.

    Raises one of `READER_FAILURES` if it cannot, at construction or at any message.
    """

    def __init__(self, path: Path, allowance: Allowance) -> None:
        self._reader: rosbag1.Reader | rosbag2.Reader
        self._is_packed = False
        self._allowance = allowance
        if path.suffix == ".bag" and path.is_file():
            self._reader = open_bag_reader(path, allowance)
        else:
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

    def arrivals(self) -> Iterator[Arrival]:
        """All messages, in the order in which they were stored."""
        if isinstance(self._reader, rosbag1.Reader):
            topics = {opened.id: opened.topic for opened in self._opened}
            entries = (
                (entry.chunk_pos, entry.offset, topics[number], entry.time)
                for number, found in self._reader.indexes.items()
                for entry in found
            )
            yield from ((topic, at_ns) for _, _, topic, at_ns in sorted(entries))
            return
        for part in parts_of(self._reader):
            if isinstance(part, Sqlite3Reader):
                yield from rows_in_order(Path(str(part.path)))
            elif isinstance(part, McapReader):
                topics = {opened.id: opened.topic for opened in part.connections}
                yield from records_in_order(Path(str(part.path)), topics, self._allowance)

    def close(self) -> None:
        """Release the file."""
        self._reader.close()


def _connection(opened: RosbagsConnection) -> Connection:
    ext = opened.ext
    return Connection(
        id=opened.id,
        topic=opened.topic,
        message_type=plain_type(opened.msgtype),
        encoding=ext.serialization_format if isinstance(ext, ConnectionExtRosbag2) else "ros1",
        definition=opened.msgdef,
        count=opened.msgcount,
    )
