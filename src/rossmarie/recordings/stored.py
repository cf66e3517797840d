"""Stored messages, still as bytes: one by one, and in batches.

A batch is one block of bytes, with columns for the places in it.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from operator import index as as_index
from typing import NamedTuple

import apsw
import numpy as np
from numpy.typing import NDArray
from rosbags import rosbag1, rosbag2
from rosbags.interfaces import MessageDefinition

from rossmarie.ir import EARLIEST_NS, LATEST_NS
from rossmarie.recordings.compression import DECOMPRESSION_FAILURES

_MOST_MESSAGES = 4096
_MOST_BYTES = 512 << 10

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
"""The exceptions that rosbags raises on damaged files. rosbags does not validate most of their
content, so a wrong byte can cause almost any Python exception.
"""


@dataclass(frozen=True)
class RecordedConnection:
    """One source of messages on a topic; `id` is its number in the file.

    `message_type` is, for example, `sensor_msgs/Imu`. `encoding` is `ros1`, `cdr`, or an encoding
    that cannot be decoded here. `definition` may be empty.
    """

    id: int
    topic: str
    message_type: str
    encoding: str
    definition: MessageDefinition
    count: int


def plain_type(name: str) -> str:
    """`sensor_msgs/Imu` for `sensor_msgs/msg/Imu`; other kinds of interfaces keep their name."""
    return name.replace("/msg/", "/", 1)


class Stored(NamedTuple):
    """One message as it is stored."""

    connection: RecordedConnection
    at_ns: int
    content: bytes


@dataclass(frozen=True, eq=False)
class Packed:
    """Messages in the order of their stamps. Message i is `content[starts[i] : ends[i]]`, from
    `connections[senders[i]]`. Stamps out of range are set to the end of the 64-bit range.
    """

    connections: Sequence[RecordedConnection]
    senders: NDArray[np.intp]
    times_ns: NDArray[np.int64]
    content: bytes
    starts: NDArray[np.int64]
    ends: NDArray[np.int64]

    def __len__(self) -> int:
        """The number of messages."""
        return len(self.times_ns)

    def only(self, chosen: NDArray[np.bool_] | NDArray[np.intp]) -> Packed:
        """Some of the messages."""
        return replace(
            self,
            senders=self.senders[chosen],
            times_ns=self.times_ns[chosen],
            starts=self.starts[chosen],
            ends=self.ends[chosen],
        )

    def message(self, row: int) -> bytes:
        """The content of one message."""
        return self.content[self.starts[row] : self.ends[row]]


def unpacked(batch: Packed) -> Iterator[Stored]:
    """The messages of a batch, one by one."""
    columns = (batch.senders, batch.times_ns, batch.starts, batch.ends)
    for sender, at_ns, start, end in zip(*(column.tolist() for column in columns), strict=True):
        yield Stored(batch.connections[sender], at_ns, batch.content[start:end])


def packed(messages: Iterable[Stored]) -> Iterator[Packed]:
    """Messages in batches. If reading fails, the messages before the failure come first."""
    remaining = iter(messages)
    while True:
        taken: list[Stored] = []
        failure = _take(remaining, taken)
        if taken:
            yield _pack(taken)
        if failure is not None:
            raise failure
        if not taken:
            return


def _take(messages: Iterator[Stored], taken: list[Stored]) -> Exception | None:
    """Take as many messages as fit into one batch. Returns the exception if reading fails."""
    size = 0
    try:
        for connection, at_ns, content in messages:
            # The content column of a table may hold values of any type; only bytes are read.
            is_read = isinstance(content, bytes)
            taken.append(Stored(connection, as_index(at_ns), content if is_read else b""))
            size += len(taken[-1].content)
            if len(taken) == _MOST_MESSAGES or size >= _MOST_BYTES:
                break
    except READER_FAILURES as error:
        return error
    return None


def _pack(messages: Sequence[Stored]) -> Packed:
    connections = {id(stored.connection): stored.connection for stored in messages}
    places = {key: place for place, key in enumerate(connections)}
    stamps = (clipped(stored.at_ns) for stored in messages)
    ends = np.cumsum([len(stored.content) for stored in messages], dtype=np.int64)
    return Packed(
        connections=list(connections.values()),
        senders=np.array([places[id(stored.connection)] for stored in messages], np.intp),
        times_ns=np.fromiter(stamps, np.int64, len(messages)),
        content=b"".join(stored.content for stored in messages),
        starts=np.concatenate(([0], ends[:-1])),
        ends=ends,
    )


def clipped(at_ns: int) -> int:
    """An instant in ns, limited to the range of instants."""
    return max(EARLIEST_NS, min(at_ns, LATEST_NS))
