"""ROS 1 and ROS 2 recordings, in every form in which they come."""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from rosbags.rosbag2 import CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from dslkit.diagnostics import Collector
from rossmarie.ir import Array, FieldKind
from rossmarie.recordings.batches import updates_in
from rossmarie.recordings.opening import open_recording
from support.recordings import (
    KINDS,
    ROS1,
    ROS2,
    START_NS,
    codes,
    machine,
    readings,
    replay,
    slot,
    stamped,
    store_of,
    volts,
    write_kind,
    write_mcap,
    write_ros1,
    write_ros2,
)

SCAN = machine(
    [("/scan", "sensor_msgs/LaserScan")],
    [("scan", 0)],
    [
        slot(0, "range_max"),
        slot(0, "header", "stamp"),
        slot(0, "header", "frame_id", kind=FieldKind.TEXT),
        slot(0, "ranges", 1),
        slot(0, "ranges", 7),
    ],
    [Array(0, ("ranges",), 1.0, 0.0, "m")],
    ["docked", "laser"],
)


@pytest.mark.parametrize("kind", KINDS)
def test_topics_of_every_kind(tmp_path: Path, kind: str) -> None:
    path = write_kind(tmp_path, kind, readings(store_of(kind)))
    with open_recording(path) as recording:
        assert [(t.name, t.message_type, t.count) for t in recording.topics.values()] == [
            ("/battery", "std_msgs/Float32", 10),
            ("/scan", "sensor_msgs/LaserScan", 10),
        ]
        assert recording.start_ns == START_NS
        assert recording.end_ns == START_NS + 910_000_000
        assert recording.findings == ()


@pytest.mark.parametrize("kind", KINDS)
def test_updates_of_every_kind(tmp_path: Path, kind: str) -> None:
    updates, found = replay(write_kind(tmp_path, kind, readings(store_of(kind))))
    assert found == ()
    assert [update.at_ns - START_NS for update in updates] == [i * 100_000_000 for i in range(10)]
    assert volts(updates) == [12.0 + i / 2 for i in range(10)]


@pytest.mark.parametrize("mode", [CompressionMode.FILE, CompressionMode.MESSAGE])
@pytest.mark.parametrize("plugin", StoragePlugin)
def test_compressed_bag_directories(
    tmp_path: Path, plugin: StoragePlugin, mode: CompressionMode
) -> None:
    folder = write_ros2(tmp_path / "drive", readings(ROS2), plugin, mode)
    updates, found = replay(folder)
    assert found == ()
    assert volts(updates) == [12.0 + i / 2 for i in range(10)]


@pytest.mark.parametrize("kind", ["bag", "db3", "mcap"])
def test_values_of_every_sort(tmp_path: Path, kind: str) -> None:
    updates, found = replay(write_kind(tmp_path, kind, readings(store_of(kind))), SCAN)
    assert found == ()
    values = updates[3].channels[0]
    stamp = (START_NS + 300_000_000) / 1e9
    assert values.slots[0] == 9.0
    assert values.slots[1] == pytest.approx(stamp, abs=1e-6)
    assert values.slots[2] == 1.0  # the index of "laser"
    assert values.slots[3] == 5.0
    assert values.slots[4] != values.slots[4]  # behind the end of the array: NaN
    assert values.arrays[0] == [1.0, 5.0]
    assert all(type(value) is float for value in (*values.slots.values(), *values.arrays[0]))


def test_unknown_text_is_minus_one(tmp_path: Path) -> None:
    rules = machine(
        [("/scan", "sensor_msgs/LaserScan")],
        [("scan", 0)],
        [slot(0, "header", "frame_id", kind=FieldKind.TEXT)],
        texts=["docked"],
    )
    updates, _ = replay(write_kind(tmp_path, "mcap", readings(ROS2)), rules)
    assert volts(updates) == [-1.0] * 10


def test_flags_are_numbers(tmp_path: Path) -> None:
    name = "std_msgs/msg/Bool"
    found = [("/blocked", START_NS + i, name, ROS2.types[name](data=i == 1)) for i in range(3)]
    rules = machine(
        [("/blocked", "std_msgs/Bool")], [("blocked", 0)], [slot(0, "data", kind=FieldKind.FLAG)]
    )
    updates, _ = replay(write_kind(tmp_path, "mcap", found), rules)
    assert volts(updates) == [0.0, 1.0, 0.0]


def test_two_inputs_share_a_message(tmp_path: Path) -> None:
    rules = machine(
        [("/scan", "sensor_msgs/LaserScan")],
        [("scan", 0), ("speed", 0)],
        [slot(0, "range_min"), slot(1, "range_max")],
    )
    updates, _ = replay(write_kind(tmp_path, "mcap", readings(ROS2)), rules)
    assert updates[0].channels[0].slots == {0: pytest.approx(0.1, abs=1e-6), 1: 9.0}


def test_channels_come_in_the_order_of_time(tmp_path: Path) -> None:
    rules = machine(
        [("/scan", "sensor_msgs/LaserScan"), ("/battery", "std_msgs/Float32")],
        [("scan", 0), ("battery", 1)],
        [slot(0, "range_min"), slot(1, "data")],
    )
    disordered = sorted(readings(ROS1), key=lambda reading: reading[0])
    updates, _ = replay(write_ros1(tmp_path / "drive.bag", disordered), rules)
    assert [next(iter(update.channels)) for update in updates] == [1, 0] * 10
    assert [update.at_ns for update in updates] == sorted(update.at_ns for update in updates)


def test_topic_map_leads_to_the_recorded_topic(tmp_path: Path) -> None:
    rules = machine(
        [("/power", "std_msgs/Float32"), ("/spare", "std_msgs/Float32")],
        [("battery", 0), ("speed", 1)],
        [slot(0, "data"), slot(1, "data")],
    )
    path = write_kind(tmp_path, "bag", readings(ROS1))
    updates, found = replay(path, rules, {"/power": "/battery", "/spare": "/battery"})
    assert found == ()
    assert len(updates) == 10
    assert updates[2].channels[0].slots == {0: 13.0}
    assert updates[2].channels[1].slots == {1: 13.0}


# --- bag directories -------------------------------------------------------------------------


def test_directory_without_metadata(tmp_path: Path) -> None:
    folder = write_kind(tmp_path, "mcap directory", readings(ROS2))
    (folder / "metadata.yaml").unlink()
    updates, found = replay(folder)
    assert found == ()
    assert len(updates) == 10


def test_split_recording_without_metadata(tmp_path: Path) -> None:
    """Its parts overlap in time: every third message of each topic is in the same one."""
    folder = tmp_path / "split"
    folder.mkdir()
    everything = readings(ROS2, 12)
    for number in range(3):
        name = f"part{number}"
        part = write_ros2(tmp_path / name, everything[number::3], StoragePlugin.SQLITE3)
        shutil.copy(part / f"{name}.db3", folder / f"drive_{number}.db3")
    updates, found = replay(folder)
    assert found == ()
    assert volts(updates) == [12.0 + i / 2 for i in range(12)]


def test_damaged_metadata_does_not_matter(tmp_path: Path) -> None:
    folder = write_kind(tmp_path, "db3 directory", readings(ROS2))
    (folder / "metadata.yaml").write_text("rosbag2_bagfile_information: [")
    updates, _ = replay(folder)
    assert len(updates) == 10


# --- definitions -----------------------------------------------------------------------------

OWN = "my_msgs/msg/Wheel"
LOAD = "my_msgs/msg/Load"
OWN_TEXT = "float32 speed\nmy_msgs/Load load\nstd_msgs/Header header\n"
LOAD_TEXT = "float64[3] kilograms\n"
WHEEL = machine(
    [("/wheel", "my_msgs/Wheel")],
    [("speed", 0)],
    [slot(0, "speed"), slot(0, "load", "kilograms", 2), slot(0, "header", "stamp")],
)


def write_own(folder: Path, plugin: StoragePlugin) -> Path:
    """A bag directory with one message of a type of one's own."""
    store = get_typestore(Stores.ROS2_HUMBLE)
    store.register(get_types_from_msg(OWN_TEXT, OWN) | get_types_from_msg(LOAD_TEXT, LOAD))
    load = store.types[LOAD](kilograms=np.array([1.0, 2.0, 3.0]))
    wheel = store.types[OWN](speed=1.5, load=load, header=stamped(ROS2, 0))
    with Writer(folder, version=8, storage_plugin=plugin) as writer:
        connection = writer.add_connection("/wheel", OWN, typestore=store)
        writer.write(connection, START_NS, store.serialize_cdr(wheel, OWN))
    return folder


def forget_definitions(folder: Path) -> Path:
    """Make a database like those of ROS 2 Humble and before, which hold no definitions."""
    (file,) = folder.glob("*.db3")
    with closing(sqlite3.connect(file)) as database, database:
        database.execute("DROP TABLE message_definitions")
        database.execute("UPDATE schema SET schema_version = 3")
    return folder


@pytest.mark.parametrize("plugin", StoragePlugin)
def test_recordings_bring_their_own_definitions(tmp_path: Path, plugin: StoragePlugin) -> None:
    updates, found = replay(write_own(tmp_path / "own", plugin), WHEEL)
    assert found == ()
    assert updates[0].channels[0].slots[0] == 1.5
    assert updates[0].channels[0].slots[1] == 3.0


def test_standard_types_need_no_definition(tmp_path: Path) -> None:
    folder = forget_definitions(write_kind(tmp_path, "db3 directory", readings(ROS2)))
    updates, found = replay(folder)
    assert found == ()
    assert len(updates) == 10


def test_unknown_types_are_reported(tmp_path: Path) -> None:
    _, found = replay(forget_definitions(write_own(tmp_path / "own", StoragePlugin.SQLITE3)), WHEEL)
    assert codes(found) == ["ROSS606"]
    assert "my_msgs/Wheel" in found[0].title
    assert found[0].primary.span.text == "input speed"


@pytest.mark.parametrize("layout", ["my_msgs/msg", "my_msgs"])
def test_message_folders_define_types(tmp_path: Path, layout: str) -> None:
    folder = forget_definitions(write_own(tmp_path / "own", StoragePlugin.SQLITE3))
    (tmp_path / "msg" / layout).mkdir(parents=True)
    (tmp_path / "msg" / layout / "Wheel.msg").write_text(OWN_TEXT)
    (tmp_path / "msg" / layout / "Load.msg").write_text(LOAD_TEXT)
    collector = Collector()
    with open_recording(folder, [tmp_path / "msg"]) as recording:
        updates = list(updates_in(WHEEL, recording.batches(WHEEL, collector, {})))
    assert collector.sorted() == ()
    assert updates[0].channels[0].slots[1] == 3.0


def test_ros1_messages_in_mcap(tmp_path: Path) -> None:
    """As converters make them of a ROS 1 bag."""
    name = "std_msgs/msg/Float32"
    text, _ = ROS1.generate_msgdef(name, ros_version=1)
    content = bytes(ROS1.serialize_ros1(ROS1.types[name](data=12.5), name))
    path = write_mcap(
        tmp_path / "drive.mcap",
        profile="ros1",
        schema=("std_msgs/Float32", "ros1msg", text),
        channel=("/battery", "ros1"),
        messages=[(START_NS, content)],
    )
    updates, found = replay(path)
    assert found == ()
    assert volts(updates) == [12.5]


def test_messages_in_another_encoding_are_reported(tmp_path: Path) -> None:
    path = write_mcap(
        tmp_path / "drive.mcap",
        profile="",
        schema=("std_msgs/Float32", "jsonschema", "{}"),
        channel=("/battery", "json"),
        messages=[(START_NS, b'{"data": 12.5}')],
    )
    updates, found = replay(path)
    assert updates == []
    assert codes(found) == ["ROSS606"]
    assert "`json`" in found[0].notes[0]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ('a/msg/B:\n    pass\nraise SystemExit("executed")\nclass C', "float32 data"),
        ("a/msg/B", "float32 data\n\n" + "=" * 80 + "\nMSG: a/5C\nfloat32 data"),
        ("a/msg/B", "no such type ("),
        ("a/msg/B", "a/Missing part"),
    ],
)
def test_definitions_that_make_no_sense_are_reported(tmp_path: Path, name: str, text: str) -> None:
    """Decoders are made of them: a name must not smuggle in code."""
    path = write_mcap(
        tmp_path / "drive.mcap",
        profile="ros2",
        schema=(name, "ros2msg", text),
        channel=("/wheel", "cdr"),
        messages=[(START_NS, b"\0\1\0\0\0\0\0\0")],
    )
    plain = name.replace("/msg/", "/")
    rules = machine([("/wheel", plain)], [("speed", 0)], [slot(0, "data")])
    updates, found = replay(path, rules)
    assert updates == []
    assert codes(found) == ["ROSS606"]
    assert "cannot be parsed" in found[0].notes[0]
