"""ROS 1 .bag files without a usable index: not closed by the recorder, cut short, or damaged.

Format: https://wiki.ros.org/Bags/Format/2.0. A record consists of a header (fields `name=value`)
and data, each after its length. Messages and connections lie inside the data of chunks.
"""

from __future__ import annotations

import mmap
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from rosbags.interfaces import MessageDefinition, MessageDefinitionFormat

from rossmarie.recordings.salvage import OUTSIDE, Chunk, MessagePlace, SalvagedStorage, SalvageScan
from rossmarie.recordings.stored import RecordedConnection

_MAGIC = b"#ROSBAG V2.0\n"
_MESSAGE, _CHUNK, _CONNECTION = b"\x02", b"\x05", b"\x07"
_BAG_HEADER, _INDEX, _CHUNK_INFO = b"\x03", b"\x04", b"\x06"
_OPERATIONS = (_MESSAGE, _BAG_HEADER, _INDEX, _CHUNK, _CHUNK_INFO, _CONNECTION)
_ANY_SIZE = -1
_NEEDED = {
    _MESSAGE: ((b"conn", 4), (b"time", 8)),
    _CONNECTION: ((b"conn", 4), (b"topic", _ANY_SIZE)),
    _CHUNK: ((b"compression", _ANY_SIZE),),
}
_LENGTH = struct.Struct("<I")
_TIME = struct.Struct("<II")


def salvage_bag(path: Path) -> SalvagedStorage:
    """The readable rest of a ROS 1 bag. Raises `ValueError` if the file is not a ROS 1 bag."""
    return SalvagedStorage(path, _scan)


class _Record(NamedTuple):
    """A record. `is_whole` is True if the file contains all of its data."""

    fields: dict[bytes, bytes]
    start: int
    end: int
    is_whole: bool


def _scan(data: mmap.mmap, scan: SalvageScan) -> None:
    if data[: len(_MAGIC)] != _MAGIC:
        raise ValueError("it does not start like a ROS 1 bag (version 2.0)")
    is_indexed = False
    for record in _records(data, len(_MAGIC), scan):
        is_indexed = is_indexed or record.fields[b"op"] == _CHUNK_INFO
        if record.fields[b"op"] == _CHUNK:
            _scan_chunk(data, record, scan)
        elif record.is_whole:
            _keep(data, record, OUTSIDE, scan)
    if not is_indexed:
        scan.lose("it has no index, because recording was not ended properly")


def _scan_chunk(data: mmap.mmap, record: _Record, scan: SalvageScan) -> None:
    if not record.is_whole:
        scan.lose(f"it is cut short inside a chunk, at byte {len(data)}")
    compression = record.fields[b"compression"].decode(errors="replace")
    number, content = scan.open_chunk(data, Chunk(compression, record.start, record.end))
    for inner in _records(content, 0, scan, f" of the chunk at byte {record.start}"):
        if inner.is_whole:
            _keep(content, inner, number, scan)


def _keep(data: bytes | mmap.mmap, record: _Record, chunk: int, scan: SalvageScan) -> None:
    fields = record.fields
    if fields[b"op"] == _CONNECTION:
        connection = _connection(fields, data[record.start : record.end])
        scan.connections.setdefault(connection.id, connection)
    elif fields[b"op"] == _MESSAGE:
        seconds, nanoseconds = _TIME.unpack(fields[b"time"])
        (number,) = _LENGTH.unpack(fields[b"conn"])
        at_ns = seconds * 1_000_000_000 + nanoseconds
        scan.keep(MessagePlace(at_ns, number, chunk, record.start, record.end))


def _records(
    data: bytes | mmap.mmap, position: int, scan: SalvageScan, of: str = ""
) -> Iterator[_Record]:
    """The records from `position` on, up to the first invalid record. `of` names their source."""
    size = len(data)
    while position + 4 <= size:
        start = position
        try:
            (length,) = _LENGTH.unpack_from(data, position)
            position += 4 + length
            fields = _fields(data[start + 4 : position])
            (length,) = _LENGTH.unpack_from(data, position)
        except (struct.error, ValueError):
            scan.lose(f"its records break off at byte {start}{of}")
            return
        if not _is_complete(fields):
            scan.lose(f"there is an invalid record at byte {start}{of}")
            return
        position += 4
        yield _Record(fields, position, min(position + length, size), position + length <= size)
        position += length


def _fields(header: bytes) -> dict[bytes, bytes]:
    fields = {}
    position = 0
    while position < len(header):
        (length,) = _LENGTH.unpack_from(header, position)
        name, separator, value = header[position + 4 : position + 4 + length].partition(b"=")
        if not separator:
            raise ValueError("a header field without a value")
        fields[name] = value
        position += 4 + length
    return fields


def _is_complete(fields: dict[bytes, bytes]) -> bool:
    """Say whether a record contains all fields that are read, in the right size."""
    operation = fields.get(b"op", b"")
    return operation in _OPERATIONS and all(
        name in fields and size in (_ANY_SIZE, len(fields[name]))
        for name, size in _NEEDED.get(operation, ())
    )


def _connection(fields: dict[bytes, bytes], data: bytes) -> RecordedConnection:
    (number,) = _LENGTH.unpack(fields[b"conn"])
    try:
        about = _fields(data)
    except (struct.error, ValueError):
        about = {}
    text = about.get(b"message_definition", b"").decode(errors="replace")
    has_text = b"message_definition" in about
    form = MessageDefinitionFormat.MSG if has_text else MessageDefinitionFormat.NONE
    return RecordedConnection(
        id=number,
        topic=fields[b"topic"].decode(errors="replace"),
        message_type=about.get(b"type", b"unknown/Unknown").decode(errors="replace"),
        encoding="ros1",
        definition=MessageDefinition(form, text),
        count=0,
    )
