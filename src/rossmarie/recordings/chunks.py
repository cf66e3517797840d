"""Reads chunks of messages and gives batches in the order of their stamps.

Only a few chunks are in memory, because chunks overlap little in time.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rossmarie.recordings.stored import READER_FAILURES, Packed, RecordedConnection

_MOST_MESSAGES = 4096
_MOST_BYTES = 1 << 20
_ENOUGH_BYTES = 256 << 10
"""The bytes of messages that are enough for a batch."""
_KEPT_BYTES = 4 << 20
"""The bytes of chunks that stay in memory; at least two chunks always stay."""

ROW = np.dtype(
    [
        ("at_ns", np.int64),
        ("rank", np.int64),  # takes precedence over the chunk if stamps are equal
        ("chunk", np.int64),
        ("place", np.int64),  # its number in the chunk
        ("sender", np.int64),  # its connection, among the requested ones
        ("offset", np.int64),
        ("size", np.int64),
    ]
)
"""A message in a chunk. The message or its record begins at `offset`, and has at most `size`
bytes.
"""

Rows = NDArray[np.void]
Places = tuple[NDArray[np.int64], NDArray[np.int64]]
"""The start and the end of each message in the content of its chunk."""


class Chunks(Protocol):
    """The chunks of a file, by their numbers."""

    @property
    def starts_ns(self) -> Mapping[int, int]:
        """For each chunk, an instant in ns before all its messages."""

    def rows(self, chunk: int) -> Rows:
        """The requested messages in a chunk. Raises one of `READER_FAILURES`."""

    def batches(self, rows: Rows) -> Iterator[Packed]:
        """Messages as they are stored. Raises one of `READER_FAILURES`."""


def in_order(chunks: Chunks) -> Iterator[Packed]:
    """All messages in order. If a chunk cannot be read, the messages before its start come first.
    Then the exception is raised.
    """
    waiting = _Waiting()
    for start_ns, chunk in sorted((at_ns, chunk) for chunk, at_ns in chunks.starts_ns.items()):
        if waiting.are_enough:
            yield from _in_batches(chunks, waiting.before(start_ns))
        try:
            rows = chunks.rows(chunk)
        except READER_FAILURES:
            yield from _in_batches(chunks, waiting.before(start_ns))
            raise
        waiting.add(rows)
    yield from _in_batches(chunks, waiting.before(None))


class _Waiting:
    """Messages that may have to wait for messages in chunks that are not read yet."""

    def __init__(self) -> None:
        self._old: Rows = np.empty(0, ROW)
        self._fresh: list[Rows] = []
        self._count = self._size = 0

    def add(self, rows: Rows) -> None:
        """Add the messages of another chunk."""
        if len(rows):
            self._fresh.append(rows)
            self._count += len(rows)
            self._size += int(rows["size"].sum())

    @property
    def are_enough(self) -> bool:
        """True if there are enough new messages to search for the messages that are due."""
        is_batch = self._size >= _ENOUGH_BYTES or self._count >= _MOST_MESSAGES
        return is_batch and self._count >= len(self._old) // 2

    def before(self, at_ns: int | None) -> Rows:
        """The messages before an instant, or all messages for None. They no longer wait."""
        rows = np.concatenate([self._old, *self._fresh])
        is_due = np.ones(len(rows), np.bool_) if at_ns is None else rows["at_ns"] < at_ns
        self._old, self._fresh = rows[~is_due], []
        self._count = self._size = 0
        return rows[is_due]


def _in_batches(chunks: Chunks, rows: Rows) -> Iterator[Packed]:
    """Messages in their order, several in each batch."""
    keys = ("place", "chunk", "rank", "at_ns")  # the last key is compared first
    rows = rows[np.lexsort([rows[key] for key in keys])]
    ends = np.cumsum(rows["size"])
    start = 0
    while start < len(rows):
        before = ends[start - 1] if start else 0
        stop = int(np.searchsorted(ends, before + _MOST_BYTES, side="right"))
        stop = min(max(stop, start + 1), start + _MOST_MESSAGES)
        yield from chunks.batches(rows[start:stop])
        start = stop


class Contents:
    """The contents of chunks; the last few stay in memory. `load` may raise one of
    `READER_FAILURES`.
    """

    def __init__(self, load: Callable[[int], bytes]) -> None:
        self._load = load
        self._kept: OrderedDict[int, bytes] = OrderedDict()

    def of(self, chunk: int) -> bytes:
        """The content of a chunk."""
        if chunk not in self._kept:
            self._kept[chunk] = self._load(chunk)
        self._kept.move_to_end(chunk)
        while len(self._kept) > 2 and sum(map(len, self._kept.values())) > _KEPT_BYTES:
            self._kept.popitem(last=False)
        return self._kept[chunk]


def pack(
    rows: Rows,
    connections: Sequence[RecordedConnection],
    contents: Contents,
    find: Callable[[bytes, Rows], Places],
) -> Packed:
    """Messages of some chunks as one batch; `find` gives their places in the contents of their
    chunks.
    """
    starts, ends = np.empty(len(rows), np.int64), np.empty(len(rows), np.int64)
    pieces: list[bytes] = []
    size = 0
    for chunk in sorted(set(rows["chunk"].tolist())):
        here = np.flatnonzero(rows["chunk"] == chunk)
        content = contents.of(chunk)
        piece, found_starts, found_ends = _cut_out(content, *find(content, rows[here]))
        starts[here], ends[here] = found_starts + size, found_ends + size
        pieces.append(piece)
        size += len(piece)
    return Packed(
        connections=connections,
        senders=rows["sender"].astype(np.intp),
        times_ns=np.ascontiguousarray(rows["at_ns"]),
        content=pieces[0] if len(pieces) == 1 else b"".join(pieces),
        starts=starts,
        ends=ends,
    )


def _cut_out(
    content: bytes, starts: NDArray[np.int64], ends: NDArray[np.int64]
) -> tuple[bytes, NDArray[np.int64], NDArray[np.int64]]:
    """Messages of a chunk, and their new places. The result is the whole chunk if it contains
    little else.
    """
    lengths = ends - starts
    if len(content) <= 2 * int(lengths.sum()):
        return content, starts, ends
    places = zip(starts.tolist(), ends.tolist(), strict=True)
    after = np.cumsum(lengths)
    return b"".join([content[start:end] for start, end in places]), after - lengths, after
