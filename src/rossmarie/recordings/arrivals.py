"""The order in which the messages of ROS 2 files were stored, found without decoding messages."""

from __future__ import annotations

import sqlite3
import struct
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from rossmarie.recordings.clock import Arrivals, by_topic, stamps_of
from rossmarie.recordings.compression import decompress_prefix
from rossmarie.recordings.limits import Allowance

_MAGIC_SIZE = 8
_BEYOND = 2**63
_RECORD = struct.Struct("<BQ")
_MESSAGE, _CHUNK, _INDEX, _DATA_END = 0x05, 0x06, 0x07, 0x0F
_MESSAGE_HEAD = struct.Struct("<HIQ")  # channel, sequence, log time
_CHUNK_HEAD = struct.Struct("<QQQII")  # ..., the length of the compression's name
_SIZE = struct.Struct("<Q")
_INDEX_HEAD = struct.Struct("<HI")  # channel, size of the entries
_INDEX_ENTRY = np.dtype([("at_ns", "<u8"), ("offset", "<u8")])

_Index = tuple[int, NDArray[np.void]]
"""A channel, and the stamps and offsets of its messages in a chunk."""


def rows_in_order(path: Path) -> Iterator[Arrivals]:
    """The messages of a .db3 file. Raises `sqlite3.Error` for a damaged file."""
    database = sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro&immutable=1", uri=True)
    try:
        rows = database.execute(
            "SELECT topics.name, messages.timestamp FROM messages "
            "JOIN topics ON messages.topic_id = topics.id ORDER BY messages.id"
        )
        yield from by_topic(rows)
    finally:
        database.close()


def records_in_order(
    path: Path, topics: Mapping[int, str], allowance: Allowance
) -> Iterator[Arrivals]:
    """The messages of an MCAP file. For each chunk they come from the indexes after it. If the
    writer has left out the indexes, they come from the chunk itself. `topics` maps channel numbers
    to topics.

    Raises `struct.error` or `KeyError` if the file is damaged.
    """
    size = path.stat().st_size
    chunk: tuple[int, int] | None = None
    indexed: list[_Index] = []
    with path.open("rb") as file:
        file.seek(_MAGIC_SIZE)
        while file.tell() < size:
            operation, length = _RECORD.unpack(file.read(_RECORD.size))
            start = file.tell()
            if operation == _INDEX:
                indexed.append(_index(file.read(length)))
            elif operation in (_CHUNK, _DATA_END):
                if chunk is not None and any(len(entries) for _, entries in indexed):
                    yield from _as_indexed(indexed, topics)
                elif chunk is not None:
                    entries = _chunk_entries(file, *chunk, allowance)
                    yield from by_topic((topics[channel], at_ns) for channel, at_ns in entries)
                chunk, indexed = (start, length), []
            elif operation == _MESSAGE:
                channel, _, at_ns = _MESSAGE_HEAD.unpack(file.read(_MESSAGE_HEAD.size))
                yield topics[channel], stamps_of([at_ns])
            if operation == _DATA_END:
                return
            file.seek(start + length)


def _index(content: bytes) -> _Index:
    """The messages in an index record."""
    channel, size = _INDEX_HEAD.unpack_from(content)
    entries = content[_INDEX_HEAD.size : _INDEX_HEAD.size + size]
    return channel, np.frombuffer(entries, _INDEX_ENTRY)


def _as_indexed(indexed: Sequence[_Index], topics: Mapping[int, str]) -> Iterator[Arrivals]:
    """The messages of a chunk."""
    found: dict[str, list[NDArray[np.void]]] = {}
    for channel, entries in indexed:
        if len(entries):
            found.setdefault(topics[channel], []).append(entries)
    for topic, parts in found.items():
        entries = np.concatenate(parts)
        stamps = entries["at_ns"][np.argsort(entries["offset"], kind="stable")]
        is_small = stamps.max() < _BEYOND
        yield topic, stamps.astype(np.int64) if is_small else stamps.astype(np.object_)


def _chunk_entries(
    file: BinaryIO, start: int, length: int, allowance: Allowance
) -> Iterator[tuple[int, int]]:
    """Channel and stamp of each message in a chunk."""
    file.seek(start)
    chunk = file.read(length)
    *_, name_size = _CHUNK_HEAD.unpack_from(chunk)
    name_end = _CHUNK_HEAD.size + name_size
    compression = chunk[_CHUNK_HEAD.size : name_end].decode(errors="replace")
    content, _ = decompress_prefix(compression, chunk[name_end + _SIZE.size :], allowance)
    offset = 0
    while offset < len(content):
        operation, size = _RECORD.unpack_from(content, offset)
        if operation == _MESSAGE:
            channel, _, at_ns = _MESSAGE_HEAD.unpack_from(content, offset + _RECORD.size)
            yield channel, at_ns
        offset += _RECORD.size + size
