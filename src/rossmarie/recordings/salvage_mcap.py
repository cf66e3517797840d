"""MCAP files that rosbags does not read.

They have no footer, or are cut short or damaged. Others are complete but do not have the profile
`ros2`, for example ROS 1 messages that were converted to MCAP.

Format: https://mcap.dev/spec. A record consists of an operation (1 byte), a length (8 bytes) and
content. Chunks contain records of their own. Numbers are little-endian.
"""

from __future__ import annotations

import mmap
import struct
from binascii import crc32
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from rosbags.interfaces import MessageDefinition, MessageDefinitionFormat

from rossmarie.recordings.salvage import OUTSIDE, Chunk, MessagePlace, SalvagedStorage, SalvageScan
from rossmarie.recordings.stored import RecordedConnection, plain_type

_MAGIC = b"\x89MCAP0\r\n"
_FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _CHUNK = 2, 3, 4, 5, 6
_LAST_OPERATION = 0x0F
_RECORD = struct.Struct("<BQ")
_STRING = struct.Struct("<I")
_NUMBERS = struct.Struct("<HH")
_MESSAGE_HEADER = struct.Struct("<HIQQ")  # channel, sequence, log time, publish time
_CHUNK_HEADER = struct.Struct("<QQQI")  # first and last log time, uncompressed size, checksum
_SIZE = struct.Struct("<Q")
_DEFINITION_FORMATS = {
    "ros1msg": MessageDefinitionFormat.MSG,
    "ros2msg": MessageDefinitionFormat.MSG,
    "ros2idl": MessageDefinitionFormat.IDL,
    "omgidl": MessageDefinitionFormat.IDL,
}


def salvage_mcap(path: Path) -> SalvagedStorage:
    """The readable rest of an MCAP file. Raises `ValueError` if the file is not an MCAP file."""
    return SalvagedStorage(path, _scan)


class _Record(NamedTuple):
    """A record. `is_whole` is True if the file contains all of its content."""

    operation: int
    start: int
    end: int
    is_whole: bool


class _Schema(NamedTuple):
    name: str
    definition: MessageDefinition


def _scan(data: mmap.mmap, scan: SalvageScan) -> None:
    if data[: len(_MAGIC)] != _MAGIC:
        raise ValueError("it does not start like an MCAP file")
    schemas: dict[int, _Schema] = {}
    is_closed = False
    for record in _records(data, len(_MAGIC), scan):
        if record.operation == _FOOTER:
            is_closed = True
            break
        if record.operation == _CHUNK:
            _scan_chunk(data, record, schemas, scan)
        elif record.is_whole:
            _keep(data, record, OUTSIDE, schemas, scan)
        else:
            scan.lose(f"it is cut short, at byte {len(data)}")
    if not is_closed:
        scan.lose("it has no index, because recording was not ended properly")


def _scan_chunk(
    data: mmap.mmap, record: _Record, schemas: dict[int, _Schema], scan: SalvageScan
) -> None:
    try:
        _, _, size, checksum = _CHUNK_HEADER.unpack_from(data, record.start)
        compression, position = _string(data, record.start + _CHUNK_HEADER.size)
    except (struct.error, ValueError):
        scan.lose(f"there is an invalid chunk at byte {record.start}")
        return
    if not record.is_whole:
        scan.lose(f"it is cut short inside a chunk, at byte {len(data)}")
    number, content = scan.open_chunk(data, Chunk(compression, position + _SIZE.size, record.end))
    if record.is_whole and checksum and crc32(content) != checksum:
        scan.lose(f"the checksum of a chunk of {size} bytes at byte {record.start} is wrong")
        return
    for inner in _records(content, 0, scan, f" of the chunk at byte {record.start}"):
        if inner.is_whole:
            _keep(content, inner, number, schemas, scan)


def _keep(
    data: bytes | mmap.mmap,
    record: _Record,
    chunk: int,
    schemas: dict[int, _Schema],
    scan: SalvageScan,
) -> None:
    _, start, end, _ = record
    try:
        if record.operation == _MESSAGE:
            channel, _, at_ns, _ = _MESSAGE_HEADER.unpack_from(data, start)
            scan.keep(MessagePlace(at_ns, channel, chunk, start + _MESSAGE_HEADER.size, end))
        elif record.operation == _CHANNEL:
            connection = _connection(data[start:end], schemas)
            scan.connections.setdefault(connection.id, connection)
        elif record.operation == _SCHEMA:
            number, schema = _schema(data[start:end])
            schemas.setdefault(number, schema)
    except (struct.error, ValueError):
        scan.lose(f"there is an invalid record at byte {start}")


def _records(
    data: bytes | mmap.mmap, position: int, scan: SalvageScan, of: str = ""
) -> Iterator[_Record]:
    """The records from `position` on, up to the first invalid record. `of` names their source."""
    size = len(data)
    while position + _RECORD.size <= size:
        operation, length = _RECORD.unpack_from(data, position)
        if not 0 < operation <= _LAST_OPERATION:
            scan.lose(f"there is an invalid record at byte {position}{of}")
            return
        position += _RECORD.size
        yield _Record(operation, position, min(position + length, size), position + length <= size)
        position += length


def _connection(content: bytes, schemas: dict[int, _Schema]) -> RecordedConnection:
    number, schema_number = _NUMBERS.unpack_from(content)
    topic, position = _string(content, _NUMBERS.size)
    encoding, _ = _string(content, position)
    without = _Schema("unknown/Unknown", MessageDefinition(MessageDefinitionFormat.NONE, ""))
    schema = schemas.get(schema_number, without)
    return RecordedConnection(
        number, topic, plain_type(schema.name), encoding, schema.definition, 0
    )


def _schema(content: bytes) -> tuple[int, _Schema]:
    (number,) = struct.unpack_from("<H", content)
    name, position = _string(content, 2)
    encoding, position = _string(content, position)
    text, _ = _string(content, position)
    form = _DEFINITION_FORMATS.get(encoding, MessageDefinitionFormat.NONE)
    return number, _Schema(name, MessageDefinition(form, text))


def _string(data: bytes | mmap.mmap, position: int) -> tuple[str, int]:
    """The text at `position`, and the position of its end. Raises `ValueError` if it does not
    fit.
    """
    (length,) = _STRING.unpack_from(data, position)
    start, end = position + _STRING.size, position + _STRING.size + length
    if end > len(data):
        raise ValueError("a text reaches past the end")
    return data[start:end].decode(), end
