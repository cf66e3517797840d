"""Files that are cut short, damaged, or no recordings at all."""

from __future__ import annotations

import mmap
import os
import random
import re
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionMode, StoragePlugin
from rosbags.typesys.store import Typestore

from dslkit.diagnostics import Severity
from rossmarie.ir import Machine
from rossmarie.recordings.errors import RecordingError
from rossmarie.recordings.opening import open_recording
from rossmarie.recordings.salvage import SalvagedStorage, SalvageScan
from support.recordings import (
    ROS1,
    ROS2,
    START_NS,
    Reading,
    codes,
    machine,
    readings,
    replay,
    scan,
    slot,
    store_of,
    volts,
    write_kind,
    write_mcap,
    write_ros1,
    write_ros2,
)

VOLTS = [12.0 + i / 2 for i in range(200)]


def written(folder: Path, kind: str) -> Path:
    return write_kind(folder, kind, readings(store_of(kind), 200))


def cut(path: Path, share: float) -> Path:
    """Keep the first part of a file."""
    os.truncate(path, int(path.stat().st_size * share))
    return path


def overwrite(path: Path, position: int, content: bytes) -> Path:
    data = bytearray(path.read_bytes())
    data[position : position + len(content)] = content
    path.write_bytes(data)
    return path


@pytest.mark.parametrize("kind", ["bag", "mcap"])
@pytest.mark.parametrize("share", [0.3, 0.5])
def test_what_comes_before_the_cut_is_used(tmp_path: Path, kind: str, share: float) -> None:
    updates, found = replay(cut(written(tmp_path, kind), share))
    assert codes(found) == ["ROSS615"]
    assert found[0].severity is Severity.WARNING
    assert volts(updates) == VOLTS[: len(updates)]
    assert len(updates) > 10


@pytest.mark.parametrize("kind", ["bag", "mcap", "db3"])
def test_whatever_the_cut_nothing_breaks(tmp_path: Path, kind: str) -> None:
    whole = written(tmp_path, kind).read_bytes()
    path = tmp_path / f"cut.{kind}"
    for size in range(1, len(whole), len(whole) // 40):
        path.write_bytes(whole[:size])
        with suppress(RecordingError):
            updates, found = replay(path)
            assert volts(updates) == sorted(set(volts(updates)) & set(VOLTS))
            assert "ROSS615" in codes(found) or volts(updates) == VOLTS


@pytest.mark.parametrize("kind", ["bag", "mcap", "compressed mcap", "db3"])
def test_whatever_the_damage_nothing_breaks(tmp_path: Path, kind: str) -> None:
    whole = written(tmp_path, kind).read_bytes()
    path = tmp_path / f"damaged.{kind.split()[-1]}"
    chance = random.Random(kind)
    for _ in range(60):
        data = bytearray(whole)
        for _ in range(chance.choice((1, 4, 30))):
            data[chance.randrange(len(data))] = chance.randrange(256)
        path.write_bytes(data)
        with suppress(RecordingError):
            replay(path)


def test_bag_that_was_not_closed(tmp_path: Path) -> None:
    """A recorder that dies leaves no index, and a header that says so."""
    path = tmp_path / "active.bag"
    with Writer1(path) as writer:
        writer.chunk_threshold = 2000
        name = "std_msgs/msg/Float32"
        connection = writer.add_connection("/battery", name, typestore=ROS1)
        for _, at_ns, _, message in readings(ROS1, 200)[::2]:
            writer.write(connection, at_ns, ROS1.serialize_ros1(message, name))
        unfinished = path.read_bytes()
    path.write_bytes(unfinished)
    updates, found = replay(path)
    assert codes(found) == ["ROSS615"]
    assert volts(updates) == VOLTS[: len(updates)]
    assert len(updates) > 100


def incompressible(ros: Typestore) -> list[Reading]:
    """300 scans of 500 random ranges; the second range counts them."""
    ranges = np.random.default_rng(1).random((300, 500), dtype=np.float32)
    ranges[:, 1] = np.arange(300)
    return [
        ("/scan", START_NS + i * 100_000_000, *scan(ros, i, list(ranges[i]))) for i in range(300)
    ]


LAST_MOMENTS = machine([("/scan", "sensor_msgs/LaserScan")], [("scan", 0)], [slot(0, "ranges", 1)])


@pytest.mark.parametrize(
    ("compression", "chunk_size"),
    [
        (Writer1.CompressionFormat.LZ4, 1_000_000),  # one chunk: what is read is of the cut one
        (Writer1.CompressionFormat.BZ2, 100_000),  # has blocks of 900 kB: only whole chunks help
    ],
)
def test_compressed_bag_cut_inside_a_chunk(
    tmp_path: Path, compression: Writer1.CompressionFormat, chunk_size: int
) -> None:
    """The last moments before a robot loses power are in the chunk that is incomplete."""
    path = write_ros1(tmp_path / "drive.bag", incompressible(ROS1), chunk_size, compression)
    updates, found = replay(cut(path, 0.8), LAST_MOMENTS)
    assert codes(found) == ["ROSS615"]
    assert "inside a chunk" in found[0].title
    assert volts(updates) == [float(i) for i in range(len(updates))]
    assert len(updates) > 100


def test_compressed_mcap_cut_inside_a_chunk(tmp_path: Path) -> None:
    path = write_kind(tmp_path, "compressed mcap", incompressible(ROS2))
    updates, found = replay(cut(path, 0.8), LAST_MOMENTS)
    assert codes(found) == ["ROSS615"]
    assert "inside a chunk" in found[0].title
    assert volts(updates) == [float(i) for i in range(len(updates))]
    assert len(updates) > 100


def test_reading_goes_on_behind_a_damaged_chunk(tmp_path: Path) -> None:
    """The index of this bag is sound; what is wrong shows up on the way."""
    path = written(tmp_path, "bag")
    position = path.read_bytes().index(b"conn=", path.stat().st_size // 4)
    updates, found = replay(overwrite(path, position, b"c0nn="))
    assert codes(found) == ["ROSS615"]
    assert re.search(r"at byte \d+ of the chunk at byte \d+", found[0].title)
    assert volts(updates) == sorted(volts(updates))
    assert volts(updates)[-1] == VOLTS[-1]
    assert 190 < len(updates) < 200


def test_chunk_with_a_wrong_checksum_is_left_out(tmp_path: Path) -> None:
    name = "std_msgs/msg/Float32"
    contents = [
        bytes(ROS2.serialize_cdr(ROS2.types[name](data=value), name)) for value in VOLTS[:4]
    ]
    path = write_mcap(
        tmp_path / "drive.mcap",
        profile="ros2",
        schema=(name, "ros2msg", "float32 data\n"),
        channel=("/battery", "cdr"),
        messages=[(START_NS + i, content) for i, content in enumerate(contents)],
        checksums=[-1, 12345, 0, -1],  # 0: none was computed
    )
    updates, found = replay(path)
    assert codes(found) == ["ROSS615"]
    assert "checksum" in found[0].title
    assert volts(updates) == [VOLTS[0], VOLTS[2], VOLTS[3]]


def test_database_with_a_damaged_page(tmp_path: Path) -> None:
    path = written(tmp_path, "db3")
    middle = path.stat().st_size // 2 // 4096 * 4096
    updates, found = replay(overwrite(path, middle, b"\xff" * 4096))
    assert codes(found) == ["ROSS615"]
    assert set(volts(updates)) < set(VOLTS)
    assert len(updates) > 100


def test_database_cut_short(tmp_path: Path) -> None:
    """Its pages are not in the order of time: what is left has gaps."""
    updates, found = replay(cut(written(tmp_path, "db3"), 0.6))
    assert codes(found) == ["ROSS615"]
    assert volts(updates) == sorted(set(volts(updates)) & set(VOLTS))
    assert len(updates) > 10


@pytest.mark.parametrize("kind", ["db3 directory", "mcap directory"])
def test_directory_with_a_cut_file(tmp_path: Path, kind: str) -> None:
    folder = written(tmp_path, kind)
    cut(next(file for file in folder.iterdir() if file.suffix != ".yaml"), 0.6)
    updates, found = replay(folder)
    assert "ROSS615" in codes(found)
    assert set(volts(updates)) < set(VOLTS)
    assert len(updates) > 10


def test_the_finding_says_how_much_was_read(tmp_path: Path) -> None:
    path = cut(written(tmp_path, "bag"), 0.5)
    with open_recording(path) as recording:
        (finding,) = recording.findings
        kept = sum(topic.count for topic in recording.topics.values())
    assert f"{kept} messages" in finding.notes[0]
    assert finding.primary.span.file.path == str(path)


# --- nothing to read -------------------------------------------------------------------------


def refusal(path: Path, rules: Machine | None = None) -> RecordingError:
    with pytest.raises(RecordingError) as caught:
        replay(path, rules) if rules else open_recording(path)
    return caught.value


def test_missing_file_with_a_similar_name(tmp_path: Path) -> None:
    write_ros1(tmp_path / "drive.bag", readings(ROS1))
    error = refusal(tmp_path / "drvie.bag")
    assert error.diagnostic.code == "ROSS610"
    assert "drive.bag" in (error.diagnostic.help or "")
    assert "drvie.bag" in str(error)


@pytest.mark.parametrize("ending", [".bag", ".db3", ".mcap", ".csv"])
def test_empty_file(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"empty{ending}"
    path.touch()
    assert refusal(path).diagnostic.code == "ROSS613"


@pytest.mark.parametrize("kind", ["mcap", "db3"])
def test_recording_without_a_message(tmp_path: Path, kind: str) -> None:
    path = write_kind(tmp_path, kind, [])
    assert refusal(path).diagnostic.code == "ROSS613"


@pytest.mark.parametrize("ending", [".bag", ".db3", ".mcap"])
@pytest.mark.parametrize("content", [b"\0", b"time,/a.x\n1,2\n", bytes(range(256)) * 40])
def test_file_of_another_kind(tmp_path: Path, ending: str, content: bytes) -> None:
    path = tmp_path / f"other{ending}"
    path.write_bytes(content)
    assert refusal(path).diagnostic.code == "ROSS614"


def test_unknown_ending(tmp_path: Path) -> None:
    path = tmp_path / "drive.pcap"
    path.write_bytes(b"data")
    error = refusal(path)
    assert error.diagnostic.code == "ROSS612"
    assert "`.pcap`" in error.diagnostic.title


def test_directory_without_a_recording(tmp_path: Path) -> None:
    assert refusal(tmp_path).diagnostic.code == "ROSS612"


def test_directory_with_several_recordings(tmp_path: Path) -> None:
    for name in ("a.bag", "b.bag"):
        write_ros1(tmp_path / name, readings(ROS1))
    error = refusal(tmp_path)
    assert error.diagnostic.code == "ROSS612"
    assert "`a.bag`, `b.bag`" in error.diagnostic.title


def test_path_that_cannot_be_followed(tmp_path: Path) -> None:
    path = tmp_path / "loop.bag"
    path.symlink_to(path)
    assert refusal(path).diagnostic.code in ("ROSS610", "ROSS611")


def test_name_that_is_too_long(tmp_path: Path) -> None:
    assert refusal(tmp_path / f"{'x' * 5000}.bag").diagnostic.code in ("ROSS610", "ROSS611")


def packed_folder(tmp_path: Path) -> Path:
    return write_ros2(
        tmp_path / "drive", readings(ROS2), StoragePlugin.SQLITE3, CompressionMode.FILE
    )


def test_compressed_file_with_damaged_metadata(tmp_path: Path) -> None:
    folder = packed_folder(tmp_path)
    (folder / "metadata.yaml").write_text("{}")
    updates, found = replay(folder)
    assert (len(updates), found) == (10, ())


def test_compressed_file_cut_short(tmp_path: Path) -> None:
    folder = packed_folder(tmp_path)
    (packed,) = folder.glob("*.zstd")
    packed.write_bytes(packed.read_bytes()[:-100])
    error = refusal(folder)
    assert error.diagnostic.code == "ROSS614"
    assert "zstd -d" in error.diagnostic.title


def test_last_file_of_a_split_recording_is_empty(tmp_path: Path) -> None:
    path = written(tmp_path, "mcap directory")
    (path / "metadata.yaml").unlink()
    (path / "drive_1.mcap").touch()
    updates, found = replay(path)
    assert found == ()
    assert len(updates) == 200


def test_ros2_file_named_as_ros1(tmp_path: Path) -> None:
    path = write_kind(tmp_path, "mcap", readings(ROS2))
    renamed = path.rename(tmp_path / "drive.bag")
    assert "does not start like a ROS 1 bag" in refusal(renamed).diagnostic.title


# --- what is open, and what is read twice ----------------------------------------------------


def test_a_file_that_is_no_recording_is_closed(tmp_path: Path) -> None:
    opened: list[mmap.mmap] = []

    def refuse(data: mmap.mmap, scan: SalvageScan) -> None:
        opened.append(data)
        raise ValueError("no")

    path = tmp_path / "drive.bag"
    path.write_bytes(b"content")
    with pytest.raises(ValueError, match="no"):
        SalvagedStorage(path, refuse)
    assert opened[0].closed
