"""Storages that break off while they are read, or when they are opened."""

from __future__ import annotations

import tracemalloc
from collections.abc import Collection, Iterator
from pathlib import Path

import pytest
from rosbags.interfaces import MessageDefinition, MessageDefinitionFormat

from dslkit.diagnostics import Collector
from rossmarie.recordings import bag_opening
from rossmarie.recordings.bag import BagRecording
from rossmarie.recordings.batches import updates_in
from rossmarie.recordings.clock import Arrivals, by_topic
from rossmarie.recordings.opening import open_recording
from rossmarie.recordings.stored import Packed, RecordedConnection, Stored, packed
from support.recordings import machine, slot

READING = machine([("/a", "std_msgs/UInt8")], [("battery", 0)], [slot(0, "data")])


class Stub:
    """A storage of some messages that breaks off after them, if it is told to."""

    loss = None

    def __init__(self, *messages: tuple[int, bytes], breaks: bool = False) -> None:
        undefined = MessageDefinition(MessageDefinitionFormat.NONE, "")
        self.connections = [
            RecordedConnection(1, "/a", "std_msgs/UInt8", "cdr", undefined, len(messages))
        ]
        self.is_closed = False
        self._messages = messages
        self._breaks = breaks

    def span(self) -> tuple[int, int]:
        return self._messages[0][0], self._messages[-1][0]

    def messages(self, topics: Collection[str]) -> Iterator[Stored]:
        for at_ns, content in self._messages:
            if self.connections[0].topic in topics:
                yield Stored(self.connections[0], at_ns, b"\0\1\0\0" + content)
        if self._breaks:
            raise OSError("broken")

    def batches(self, topics: Collection[str]) -> Iterator[Packed]:
        return packed(self.messages(topics))

    def arrivals(self) -> Iterator[Arrivals]:
        return by_topic((self.connections[0].topic, at_ns) for at_ns, _ in self._messages)

    def close(self) -> None:
        self.is_closed = True


def test_messages_at_the_instant_of_the_damage_are_read_once(tmp_path: Path) -> None:
    broken = Stub((1, b"a"), (2, b"b"), (2, b"c"), breaks=True)
    whole = Stub((1, b"a"), (2, b"b"), (2, b"c"), (2, b"d"), (2, b"c"), (3, b"e"))
    recording = BagRecording(tmp_path / "drive.bag", broken, (1, 2), lambda: (whole, ()))
    updates = updates_in(READING, recording.batches(READING, Collector(), {}))
    found = [update.channels[0].slots[0] for update in updates]
    assert found == [float(letter) for letter in b"abcdce"]


def test_earlier_parts_are_closed_if_a_later_one_fails(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = Stub((1, b"a"))

    def open_part(path: Path) -> Stub:
        if path.stem == "drive_1":
            raise MemoryError
        return first

    monkeypatch.setitem(bag_opening._SALVAGE, ".mcap", open_part)
    for number in (0, 1):
        (tmp_path / f"drive_{number}.mcap").write_bytes(b"damaged")
    with pytest.raises(MemoryError):
        open_recording(tmp_path)
    assert first.is_closed


class Flood(Stub):
    """A hundred large messages at one instant."""

    def messages(self, topics: Collection[str]) -> Iterator[Stored]:
        for _ in range(100):
            yield Stored(self.connections[0], len(topics), bytes(100_000))


def test_messages_at_one_instant_are_not_kept_for_later_damage(tmp_path: Path) -> None:
    recording = BagRecording(tmp_path / "drive.bag", Flood((1, b"")), (1, 1), lambda: (Stub(), ()))
    tracemalloc.start()
    batches = recording.batches(READING, Collector(), {})
    assert sum(len(batch.times_ns) for batch in batches) == 100
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 2_000_000  # bytes, of 10 million that went by
