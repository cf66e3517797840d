"""Recordings whose clock was set back on the way."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest
from rosbags.rosbag2 import CompressionMode, StoragePlugin
from rosbags.typesys.store import Typestore

from support.recordings import (
    KINDS,
    ROS1,
    ROS2,
    START_NS,
    Reading,
    battery,
    codes,
    readings,
    replay,
    store_of,
    write_kind,
    write_mcap,
    write_ros1,
    write_ros2,
)

SECOND_NS = 1_000_000_000


def at_seconds(ros: Typestore, *seconds: float) -> list[Reading]:
    """Messages on /battery, stored in this order."""
    return [
        ("/battery", START_NS + int(at * SECOND_NS), *battery(ros, float(index)))
        for index, at in enumerate(seconds)
    ]


@pytest.mark.parametrize("kind", KINDS)
def test_a_clock_that_was_set_back_is_reported(tmp_path: Path, kind: str) -> None:
    stored = at_seconds(store_of(kind), 0, 5, 10, 0.5, 5.5, 3.5)
    updates, found = replay(write_kind(tmp_path, kind, stored))
    assert codes(found) == ["ROSS618"]
    assert found[0].title == "the timestamps go back 2 times, by up to 9.5 s"
    assert [update.at_ns for update in updates] == sorted(update.at_ns for update in updates)


def test_a_clock_that_was_set_back_is_reported_of_compressed_files(tmp_path: Path) -> None:
    stored = at_seconds(ROS2, 0, 5, 2)
    folder = write_ros2(tmp_path / "drive", stored, StoragePlugin.SQLITE3, CompressionMode.FILE)
    assert codes(replay(folder)[1]) == ["ROSS618"]


@pytest.mark.parametrize("kind", ["bag", "db3", "mcap"])
def test_a_message_may_be_stored_late(tmp_path: Path, kind: str) -> None:
    stored = at_seconds(store_of(kind), 0, 5, 4.1, 6)
    assert replay(write_kind(tmp_path, kind, stored))[1] == ()


@pytest.mark.parametrize("kind", ["bag", "db3", "mcap"])
def test_topics_may_be_stored_one_after_the_other(tmp_path: Path, kind: str) -> None:
    stored = sorted(readings(store_of(kind), 100), key=lambda reading: reading[0])
    assert replay(write_kind(tmp_path, kind, stored))[1] == ()


def test_a_clock_that_was_set_back_between_chunks(tmp_path: Path) -> None:
    stored = at_seconds(ROS1, *range(100), *range(100))
    _, found = replay(write_ros1(tmp_path / "drive.bag", stored, chunk_size=100))
    assert found[0].title == "the timestamps go back once, by up to 99.0 s"


def test_a_clock_that_was_set_back_is_reported_of_damaged_files(tmp_path: Path) -> None:
    content = bytes(ROS2.serialize_cdr(battery(ROS2, 1.0)[1], "std_msgs/msg/Float32"))
    stamps = [START_NS + second * SECOND_NS for second in (0, 5, 2)]
    path = write_mcap(
        tmp_path / "drive.mcap",
        "ros2",
        ("std_msgs/msg/Float32", "ros2msg", "float32 data"),
        ("/battery", "cdr"),
        [(at_ns, content) for at_ns in stamps],
    )
    assert "ROSS618" in codes(replay(path)[1])


def test_a_clock_that_was_set_back_is_reported_of_csv(tmp_path: Path) -> None:
    path = tmp_path / "drive.csv"
    path.write_text("time,battery\n0,1\n5,2\n4.75,3\n4.75,4\n6,5\n5.9999,6\n")
    updates, found = replay(path)
    assert codes(found) == ["ROSS618"]
    assert found[0].title == "the timestamps go back 2 times, by up to 0.2 s"
    assert "in the order of the file" in found[0].notes[0]
    assert [update.at_ns / SECOND_NS for update in updates] == [0, 5, 4.75, 4.75, 6, 5.9999]


def test_a_small_setback_of_csv_is_reported_in_milliseconds(tmp_path: Path) -> None:
    path = tmp_path / "drive.csv"
    path.write_text("time,battery\n0,1\n1.002,2\n1,3\n2,4\n")
    assert replay(path)[1][0].title == "the timestamps go back once, by up to 2 ms"


@pytest.mark.parametrize("kind", ["mcap", "compressed mcap"])
def test_a_clock_that_was_set_back_is_reported_without_message_indexes(
    tmp_path: Path, kind: str
) -> None:
    path = write_kind(tmp_path, kind, at_seconds(ROS2, 0, 5, 2))
    path.write_bytes(without_message_indexes(path.read_bytes()))
    updates, found = replay(path)
    assert len(updates) == 3
    assert [one.title for one in found] == ["the timestamps go back once, by up to 3.0 s"]


def without_message_indexes(content: bytes) -> bytes:
    """An MCAP file whose message indexes are records of a kind that readers pass over."""
    found = bytearray(content)
    position = 8
    while found[position] != 0x0F:
        if found[position] == 0x07:
            found[position] = 0x80
        (length,) = struct.unpack_from("<Q", found, position + 1)
        position += 9 + length
    return bytes(found)
