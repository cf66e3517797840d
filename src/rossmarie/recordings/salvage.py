"""Common parts of the salvage of damaged files with chunks (.bag, .mcap).

A first pass reads the records in file order, up to the end or the first invalid record, and records
the places of messages. Then the messages are read in order of time.
"""

from __future__ import annotations

import mmap
from collections import Counter
from collections.abc import Callable, Collection, Iterator
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from rossmarie.recordings.clock import Arrivals, by_topic
from rossmarie.recordings.compression import decompress_prefix
from rossmarie.recordings.limits import Allowance, LimitError
from rossmarie.recordings.stored import Packed, RecordedConnection, Stored, packed

OUTSIDE = -1
"""The chunk number of a message outside any chunk: the message is in the file itself."""


class MessagePlace(NamedTuple):
    """The place of a message: from `start` to `end` in the content of a chunk."""

    at_ns: int
    connection: int
    chunk: int
    start: int
    end: int


class Chunk(NamedTuple):
    """A compressed stretch of the file."""

    compression: str
    start: int
    end: int


@dataclass
class SalvageScan:
    """The findings of the first pass; `loss` describes the missing part, None if nothing is
    missing.
    """

    allowance: Allowance
    connections: dict[int, RecordedConnection] = field(default_factory=dict)
    chunks: list[Chunk] = field(default_factory=list)
    places: list[MessagePlace] = field(default_factory=list)
    loss: str | None = None

    def lose(self, reason: str) -> None:
        """Note a loss. Only the first loss is reported."""
        if self.loss is None:
            self.loss = reason

    def keep(self, place: MessagePlace) -> None:
        """Record the place of a message."""
        if len(self.places) < self.allowance.messages:
            self.places.append(place)
        else:
            self.lose("it has too many messages for a file of its size")

    def open_chunk(self, data: mmap.mmap, chunk: Chunk) -> tuple[int, bytes]:
        """The number and the decompressible content of a chunk."""
        packed = data[chunk.start : chunk.end]
        content, trouble = decompress_prefix(chunk.compression, packed, self.allowance)
        if trouble is not None:
            self.lose(f"the chunk at byte {chunk.start} is incomplete: {trouble}")
        self.chunks.append(chunk)
        return len(self.chunks) - 1, content


class SalvagedStorage:
    """The messages that a scan has found, in the order of their stamps."""

    def __init__(self, path: Path, scan_file: Callable[[mmap.mmap, SalvageScan], None]) -> None:
        with path.open("rb") as file:
            self._file = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        with ExitStack() as opened:
            opened.callback(self._file.close)
            self._allowance = Allowance(len(self._file))
            scan = SalvageScan(self._allowance)
            scan_file(self._file, scan)
            opened.pop_all()  # closed by `close`
        counts = Counter(place.connection for place in scan.places)
        self._by_id = {
            number: replace(connection, count=counts[number])
            for number, connection in scan.connections.items()
        }
        self.connections = list(self._by_id.values())
        self.loss = scan.loss
        self._chunks = scan.chunks
        self._stored = [place for place in scan.places if place.connection in self._by_id]
        self._places = sorted(self._stored, key=lambda place: place.at_ns)
        # Chunks follow each other in time and overlap a little, so few are needed at once.
        self._content = lru_cache(maxsize=4)(self._decompress)

    def span(self) -> tuple[int, int] | None:
        """The stamps of the first and the last message; None if there is none."""
        return (self._places[0].at_ns, self._places[-1].at_ns) if self._places else None

    def messages(self, topics: Collection[str]) -> Iterator[Stored]:
        """The messages on some topics."""
        for at_ns, number, chunk, start, end in self._places:
            connection = self._by_id[number]
            if connection.topic in topics:
                source = self._file if chunk == OUTSIDE else self._content(chunk)
                yield Stored(connection, at_ns, source[start:end])

    def batches(self, topics: Collection[str]) -> Iterator[Packed]:
        """The same messages in batches."""
        return packed(self.messages(topics))

    def arrivals(self) -> Iterator[Arrivals]:
        """All messages. The messages of each topic have the order in which they were stored."""
        return by_topic(
            (self._by_id[place.connection].topic, place.at_ns) for place in self._stored
        )

    def close(self) -> None:
        """Release the file."""
        self._content.cache_clear()
        self._file.close()

    def _decompress(self, number: int) -> bytes:
        """The content of a chunk. Raises `LimitError` if chunks have been decompressed too
        often.
        """
        chunk = self._chunks[number]
        packed = self._file[chunk.start : chunk.end]
        content, trouble = decompress_prefix(chunk.compression, packed, self._allowance)
        if trouble is not None and not content:
            raise LimitError(trouble)
        return content
