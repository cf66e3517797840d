"""In which order the messages of ROS 2 files were stored, without decoding any of them."""

from __future__ import annotations

import sqlite3
import struct
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import BinaryIO

from rossmarie.recordings.clock import Arrival
from rossmarie.recordings.compression import decompress_prefix
from rossmarie.recordings.limits import Allowance

_MAGIC_SIZE = 8
_RECORD = struct.Struct("<BQ")
_MESSAGE, _CHUNK, _INDEX, _DATA_END = 0x05, 0x06, 0x07, 0x0F
_MESSAGE_HEAD = struct.Struct("<HIQ")  # channel, sequence, log time
_CHUNK_HEAD = struct.Struct("<QQQII")  # ..., the length of the name of the compression
_SIZE = struct.Struct("<Q")
_INDEX_HEAD = struct.Struct("<HI")  # channel, size of the entries
_INDEX_ENTRY = struct.Struct("<QQ")  # log time, offset in the chunk

_Entry = tuple[int, int, int]
"""Offset in a chunk, stamp and channel of a message."""


def rows_in_order(path: Path) -> Iterator[Arrival]:
    """The messages of a .db3 file. Raises `sqlite3.Error` where it is damaged."""
    database = sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro&immutable=1", uri=True)
    try:
        yield from database.execute(
            "SELECT topics.name, messages.timestamp FROM messages "
            "JOIN topics ON messages.topic_id = topics.id ORDER BY messages.id"
        )
    finally:
        database.close()


def records_in_order(
    path: Path, topics: Mapping[int, str], allowance: Allowance
) -> Iterator[Arrival]:
    """The messages of an MCAP file: those of a chunk from the indexes behind it or, as writers may
    leave these out, from the chunk itself. `topics` are known by the numbers of their channels.

    Raises `struct.error` or `KeyError` where it is damaged.
    """
    size = path.stat().st_size
    chunk: tuple[int, int] | None = None
    indexed: list[_Entry] = []
    with path.open("rb") as file:
        file.seek(_MAGIC_SIZE)
        while file.tell() < size:
            operation, length = _RECORD.unpack(file.read(_RECORD.size))
            start = file.tell()
            if operation == _INDEX:
                indexed += _index_entries(file.read(length))
            elif operation in (_CHUNK, _DATA_END):
                if chunk is not None:
                    entries = sorted(indexed) or _chunk_entries(file, *chunk, allowance)
                    yield from ((topics[channel], at_ns) for _, at_ns, channel in entries)
                chunk, indexed = (start, length), []
            elif operation == _MESSAGE:
                channel, _, at_ns = _MESSAGE_HEAD.unpack(file.read(_MESSAGE_HEAD.size))
                yield topics[channel], at_ns
            if operation == _DATA_END:
                return
            file.seek(start + length)


def _index_entries(content: bytes) -> Iterator[_Entry]:
    """The messages that an index record names."""
    channel, size = _INDEX_HEAD.unpack_from(content)
    entries = content[_INDEX_HEAD.size : _INDEX_HEAD.size + size]
    for at_ns, offset in _INDEX_ENTRY.iter_unpack(entries):
        yield offset, at_ns, channel


def _chunk_entries(
    file: BinaryIO, start: int, length: int, allowance: Allowance
) -> Iterator[_Entry]:
    """The messages in a chunk."""
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
            yield offset, at_ns, channel
        offset += _RECORD.size + size
