"""The files of one recording as one storage."""

from __future__ import annotations

import heapq
from collections.abc import Collection, Iterator, Sequence
from contextlib import ExitStack

from rossmarie.recordings.clock import Arrivals
from rossmarie.recordings.storage import Storage
from rossmarie.recordings.stored import Packed, Stored, packed


class MergedStorage:
    """Several storages, merged by their stamps; `opened` closes everything that belongs to them."""

    def __init__(self, parts: Sequence[Storage], opened: ExitStack) -> None:
        self._parts = parts
        self._opened = opened
        self.connections = [connection for part in parts for connection in part.connections]

    def span(self) -> tuple[int, int] | None:
        """The stamps of the first and the last message; None if there is none."""
        spans = [span for part in self._parts if (span := part.span()) is not None]
        if not spans:
            return None
        return min(start for start, _ in spans), max(end for _, end in spans)

    def messages(self, topics: Collection[str]) -> Iterator[Stored]:
        """The messages on some topics."""
        streams = [part.messages(topics) for part in self._parts]
        return heapq.merge(*streams, key=lambda stored: stored.at_ns)

    def batches(self, topics: Collection[str]) -> Iterator[Packed]:
        """The same messages in batches."""
        if len(self._parts) == 1:
            return self._parts[0].batches(topics)
        return packed(self.messages(topics))

    def arrivals(self) -> Iterator[Arrivals]:
        """All messages. The messages of each topic have the order in which they were stored."""
        for part in self._parts:
            yield from part.arrivals()

    def close(self) -> None:
        """Release the files."""
        self._opened.close()
