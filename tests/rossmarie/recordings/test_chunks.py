"""Messages come out of chunks as rosbags gives them: the same, in the same order, up to the same
damage.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rosbags import rosbag1, rosbag2
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin

from rossmarie.recordings import chunks, readers
from rossmarie.recordings.bag_columns import BagChunks
from rossmarie.recordings.intact_bag import IntactBag
from rossmarie.recordings.limits import Allowance
from rossmarie.recordings.readers import open_bag_reader, open_ros2_reader
from rossmarie.recordings.storage import IntactStorage
from rossmarie.recordings.stored import READER_FAILURES, unpacked
from support.depth import examples
from support.recordings import ROS1, ROS2, START_NS, Reading, battery, scan, write_ros1

TOPICS = ("/a", "/b", "/c")
Reported = list[object]
"""Topic, stamp and content of each message, and at last what went wrong, if anything did."""


def reported(messages: Iterable[tuple[str, int, bytes]]) -> Reported:
    found: Reported = []
    try:
        found.extend(messages)
    except READER_FAILURES as error:
        found.append(f"{type(error).__name__}: {error}")
    except _NotOpenError:
        found.append("it does not open")
    return found


class _NotOpenError(Exception):
    """A file that the salvage would read."""


def by_rosbags(path: Path, topics: tuple[str, ...]) -> Reported:
    """The messages that rosbags itself gives, within our limits."""

    def messages() -> Iterator[tuple[str, int, bytes]]:
        allowance = Allowance(path.stat().st_size)
        with closing(_opened(lambda: _reader(path, allowance))) as reader:
            chosen = [each for each in reader.connections if each.topic in topics]
            asked = {each.id: each.topic for each in chosen}
            for opened, at_ns, content in reader.messages(chosen) if chosen else ():
                yield asked[opened.id], at_ns, content

    return reported(messages())


def _opened(opening: Callable[[], Any]) -> Any:
    try:
        return opening()
    except READER_FAILURES as error:
        raise _NotOpenError from error


def _reader(path: Path, allowance: Allowance) -> Any:
    if path.suffix != ".bag":
        return open_ros2_reader(path, allowance)[0]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(readers, "IndexedBag", rosbag1.Reader)
        return open_bag_reader(path, allowance)


def in_batches(path: Path, topics: tuple[str, ...]) -> Reported:
    def messages() -> Iterator[tuple[str, int, bytes]]:
        allowance = Allowance(path.stat().st_size)
        kind = IntactBag if path.suffix == ".bag" else IntactStorage
        with closing(_opened(lambda: kind(path, allowance))) as storage:
            for batch in storage.batches(topics):
                for connection, at_ns, content in unpacked(batch):
                    yield connection.topic, at_ns, content

    return reported(messages())


@st.composite
def readings(draw: st.DrawFn, kind: str) -> list[Reading]:
    """Stamps that go on, stay, go back a little, or far."""
    ros = ROS1 if kind == "bag" else ROS2
    steps = st.sampled_from((0, 0, 1, 1, 1, 2, 5, -1, -3, -40))
    at_ns, found = START_NS, list[Reading]()
    for number in range(draw(st.integers(1, 40))):
        at_ns += draw(steps)
        topic = draw(st.sampled_from(TOPICS))
        sent = battery(ros, float(number)) if topic != "/c" else scan(ros, number, [1.0] * number)
        found.append((topic, at_ns, *sent))
    return found


def write(folder: Path, kind: str, found: list[Reading], chunk: int, *, is_packed: bool) -> Path:
    """A recording with chunks of about so many bytes."""
    if kind == "bag":
        packing = rosbag1.Writer.CompressionFormat.LZ4 if is_packed else None
        return write_ros1(folder / "drive.bag", found, chunk, packing)
    writer = rosbag2.Writer(folder / "drive", version=9, storage_plugin=StoragePlugin.MCAP)
    if is_packed:
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    with writer:
        storage: Any = writer.storage
        opened = {
            topic: writer.add_connection(topic, name, typestore=ROS2)
            for topic, name in {(topic, name): None for topic, _, name, _ in found}
        }
        for topic, at_ns, name, message in found:
            writer.write(opened[topic], at_ns, ROS2.serialize_cdr(message, name))
            if storage.chunk.bio.tell() > chunk:
                storage.close_chunk()
    return folder / "drive" if kind == "folder" else folder / "drive" / "drive.mcap"


@st.composite
def cases(draw: st.DrawFn) -> tuple[str, list[Reading], int, bool, tuple[str, ...]]:
    kind = draw(st.sampled_from(("bag", "mcap", "folder")))
    asked = draw(st.lists(st.sampled_from(TOPICS), unique=True, min_size=1))
    chunk = draw(st.sampled_from((60, 500, 3000, 100_000)))
    return kind, draw(readings(kind)), chunk, draw(st.booleans()), tuple(asked)


@settings(max_examples=examples(4))
@given(cases(), st.sampled_from((1, 3, 4096)))
def test_the_same_messages_in_the_same_order(
    case: tuple[str, list[Reading], int, bool, tuple[str, ...]], most: int
) -> None:
    kind, found, chunk, is_packed, topics = case
    with tempfile.TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
        patch.setattr(chunks, "_MOST_MESSAGES", most)
        patch.setattr(chunks, "_KEPT_BYTES", 1000)
        path = write(Path(folder), kind, found, chunk, is_packed=is_packed)
        wanted = by_rosbags(path, topics)
        assert len(wanted) == sum(topic in topics for topic, *_ in found)
        assert in_batches(path, topics) == wanted


def test_whole_chunks_are_not_left_to_rosbags(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where records of connections lie between those of messages."""
    found = [(topic, START_NS + at, *battery(ROS1, 1.0)) for at, topic in enumerate(TOPICS * 9)]
    path = write(tmp_path, "bag", found, 200, is_packed=False)
    monkeypatch.delattr(BagChunks, "_by_rosbags")
    assert len(in_batches(path, TOPICS)) == len(found)


@st.composite
def damages(draw: st.DrawFn) -> list[tuple[float, bytes]]:
    """Damaged places in a file, from 0 to 1, with the damaging bytes."""
    others = st.sampled_from((b"\0", b"\1", b"\2", b"\7", b"\xff", b"\xff" * 4, b"\0" * 30))
    return draw(st.lists(st.tuples(st.floats(0, 1), others), min_size=1, max_size=3))


@settings(max_examples=examples(2))
@given(cases(), damages())
def test_the_same_messages_up_to_the_same_damage(
    case: tuple[str, list[Reading], int, bool, tuple[str, ...]],
    where: list[tuple[float, bytes]],
) -> None:
    kind, found, chunk, is_packed, topics = case
    with tempfile.TemporaryDirectory() as folder:
        path = write(Path(folder), kind, found, chunk, is_packed=is_packed)
        file = path / "drive.mcap" if kind == "folder" else path
        content = bytearray(file.read_bytes())
        for part, other in where:
            place = int(part * len(content))
            content[place : place + len(other)] = other[: len(content) - place]
        file.write_bytes(content)
        assert in_batches(path, topics) == by_rosbags(path, topics)
