"""The chunks of an MCAP file."""

from __future__ import annotations

import struct
import sys
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from rosbags import rosbag2
from rosbags.interfaces import Connection as RosbagsConnection
from rosbags.rosbag2 import storage_mcap
from rosbags.rosbag2.storage_mcap import ChunkInfo, McapReader

from rossmarie.ir import LATEST_NS
from rossmarie.recordings.chunks import ROW, Contents, Places, Rows, pack
from rossmarie.recordings.gathering import values_at
from rossmarie.recordings.stored import READER_FAILURES, Packed, RecordedConnection, clipped

_MESSAGE = 0x05
_RECORD = struct.Struct("<BQ")
_NUMBER = struct.Struct("<I")
_CHECKSUM = _RECORD.size + 24
"""The place of the checksum of a chunk, in bytes from its start."""
_CONTENT = _RECORD.size + 40
"""The place of its content in bytes, minus the length of the name of its compression."""
_HEAD = np.dtype([("channel", "<u2"), ("sequence", "<u4"), ("at_ns", "<u8"), ("sent_ns", "<u8")])


class McapChunks:
    """The chunks of an open file, by their start. `asked` are the requested connections, as rosbags
    and as this package represent them.
    """

    def __init__(
        self, file: McapReader, asked: Sequence[tuple[RosbagsConnection, RecordedConnection]]
    ) -> None:
        self._file = file
        self._connections = [ours for _, ours in asked]
        self._senders = np.full(1 << 16, -1)
        self._senders[[opened.id for opened, _ in asked]] = np.arange(len(asked))
        self._chunks = {
            chunk.chunk_start_offset: chunk
            for chunk in file.chunks
            if any(chunk.channel_count.get(opened.id, 0) for opened, _ in asked)
        }
        self._contents = Contents(self._load)

    @property
    def starts_ns(self) -> Mapping[int, int]:
        """See `Chunks.starts_ns`."""
        return {place: clipped(chunk.message_start_time) for place, chunk in self._chunks.items()}

    def rows(self, chunk: int) -> Rows:
        """See `Chunks.rows`."""
        about, content = self._chunks[chunk], self._contents.of(chunk)
        places = _message_places(content)
        if places is None:
            raise self._trouble_with(about)
        heads = values_at(content, _HEAD, places + _RECORD.size)
        senders = self._senders[heads["channel"]]
        is_inside = (heads["at_ns"] >= about.message_start_time) & (
            heads["at_ns"] <= about.message_end_time
        )
        chosen = np.flatnonzero((senders >= 0) & is_inside)
        chosen = chosen[np.argsort(heads["at_ns"][chosen], kind="stable")]
        rows = np.zeros(len(chosen), ROW)
        rows["at_ns"] = np.minimum(heads["at_ns"][chosen], LATEST_NS)
        rows["chunk"], rows["place"] = chunk, np.arange(len(rows))
        rows["sender"] = senders[chosen]
        rows["offset"] = places[chosen] + _RECORD.size + _HEAD.itemsize
        rows["size"] = values_at(content, "<u8", places[chosen] + 1) - _HEAD.itemsize
        return rows

    def batches(self, rows: Rows) -> Iterator[Packed]:
        """See `Chunks.batches`."""
        yield pack(rows, self._connections, self._contents, _find)

    def _load(self, chunk: int) -> bytes:
        """The content of a chunk, loaded as rosbags loads it."""
        bio, about = self._file.bio, self._chunks[chunk]
        assert bio is not None, "the file is open"
        bio.seek(chunk + _CHECKSUM)
        (checksum,) = _NUMBER.unpack(storage_mcap.read_exact(bio, _NUMBER.size))
        bio.seek(chunk + _CONTENT + len(about.compression))
        stored = storage_mcap.read_exact(bio, about.compressed_size)
        return storage_mcap.decompress(stored, about.compression, about.uncompressed_size, checksum)

    def _trouble_with(self, about: ChunkInfo) -> Exception:
        """The exception that rosbags raises for a chunk with invalid records."""
        bio = self._file.bio
        assert bio is not None, "the file is open"
        try:
            for _ in storage_mcap.msgsrc(about, {}, 0, 0, bio):
                pass
        except READER_FAILURES as error:
            return error
        return rosbag2.ReaderError("A chunk has invalid records.")


def has_chunks(part: object) -> bool:
    """Say whether the messages of a file are in chunks, and the index names each chunk once."""
    if not isinstance(part, McapReader) or not part.chunks:
        return False
    return len({chunk.chunk_start_offset for chunk in part.chunks}) == len(part.chunks)


def _find(_: bytes, rows: Rows) -> Places:
    return rows["offset"], rows["offset"] + rows["size"]


def _message_places(content: bytes) -> NDArray[np.int64] | None:
    """The places of the message records in a chunk; None if a record is invalid."""
    found: list[int] = []
    place, end = 0, len(content)
    while place < end:
        if place + _RECORD.size > end:
            return None
        operation, length = _RECORD.unpack_from(content, place)
        following = place + _RECORD.size + length
        if following > sys.maxsize:
            return None
        if operation == _MESSAGE:
            if length < _HEAD.itemsize or following > end:
                return None
            found.append(place)
        place = following
    return np.array(found, np.int64)
