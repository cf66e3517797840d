"""Clocks that were set back while a recording was made.

Stored messages are replayed in the order of their stamps. Where the clock was set back (a
simulation that was started again, a clock that was corrected), two stretches of time lie over each
other then; that shows in the order in which the messages were stored.
"""

from __future__ import annotations

import sqlite3
import struct
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import BinaryIO

from dslkit.diagnostics import Diagnostic
from rossmarie.recordings.errors import ClockSetBack, at_file

TOLERANCE_NS = 1_000_000_000
"""How late a message may be stored: recorders write in several threads, and from caches."""

Arrival = tuple[str, int]
"""The topic and the stamp of a message, in nanoseconds."""

_MAGIC_SIZE = 8
_RECORD = struct.Struct("<BQ")
_MESSAGE, _CHUNK, _INDEX, _DATA_END = 0x05, 0x06, 0x07, 0x0F
_MESSAGE_HEAD = struct.Struct("<HIQ")  # channel, sequence, log time
_INDEX_HEAD = struct.Struct("<HI")  # channel, size of the entries
_INDEX_ENTRY = struct.Struct("<QQ")  # log time, offset in the chunk


def find_setbacks(arrivals: Iterable[Arrival], path: Path) -> tuple[Diagnostic, ...]:
    """A finding if the stamps of a topic go back by more than `TOLERANCE_NS`.

    `arrivals` come in the order of storage. They are compared topic by topic, because a converter
    may have stored one topic after the other.
    """
    last: dict[str, int] = {}
    counts: Counter[str] = Counter()
    farthest_ns = 0
    for topic, at_ns in arrivals:
        back_ns = last.get(topic, at_ns) - at_ns
        last[topic] = at_ns
        if back_ns > TOLERANCE_NS:
            counts[topic] += 1
            farthest_ns = max(farthest_ns, back_ns)
    if not counts:
        return ()
    count = max(counts.values())
    often = "once" if count == 1 else f"{count} times"
    return (at_file(ClockSetBack(often=often, length=f"{farthest_ns / 1e9:.1f} s"), path),)


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


def indexed_in_order(path: Path, topics: Mapping[int, str]) -> Iterator[Arrival]:
    """The messages of an MCAP file, from the indexes behind its chunks; what is not indexed is
    passed over. `topics` are known by the numbers of their channels.

    Raises `struct.error` or `KeyError` where it is damaged.
    """
    size = path.stat().st_size
    chunk: list[tuple[int, int, int]] = []
    with path.open("rb") as file:
        file.seek(_MAGIC_SIZE)
        while file.tell() < size:
            operation, length = _RECORD.unpack(file.read(_RECORD.size))
            end = file.tell() + length
            if operation == _INDEX:
                chunk += _index_entries(file, length)
            elif operation in (_CHUNK, _DATA_END):
                yield from ((topics[channel], at_ns) for _, at_ns, channel in sorted(chunk))
                chunk.clear()
            elif operation == _MESSAGE:
                channel, _, at_ns = _MESSAGE_HEAD.unpack(file.read(_MESSAGE_HEAD.size))
                yield topics[channel], at_ns
            if operation == _DATA_END:
                return
            file.seek(end)


def _index_entries(file: BinaryIO, length: int) -> Iterator[tuple[int, int, int]]:
    """Offset in the chunk, stamp and channel of each message that an index record names."""
    content = file.read(length)
    channel, size = _INDEX_HEAD.unpack_from(content)
    entries = content[_INDEX_HEAD.size : _INDEX_HEAD.size + size]
    for at_ns, offset in _INDEX_ENTRY.iter_unpack(entries):
        yield offset, at_ns, channel
