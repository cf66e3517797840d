"""Messages if the rules and a recording do not match."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from dslkit.diagnostics import Severity
from rossmarie.ir import Array, FieldKind, Machine
from rossmarie.recordings.errors import ALL, RecordingError
from rossmarie.recordings.opening import open_recording
from support.recordings import (
    BATTERY,
    ROS1,
    ROS2,
    START_NS,
    battery,
    codes,
    machine,
    readings,
    replay,
    slot,
    volts,
    write_kind,
    write_ros1,
)


def battery_and(topic: str, message_type: str, *path: str | int, **kind: FieldKind) -> Machine:
    """Reads /battery, and something else as the input `speed`."""
    return machine(
        [("/battery", "std_msgs/Float32"), (topic, message_type)],
        [("battery", 0), ("speed", 1)],
        [slot(0, "data"), slot(1, *path, **kind)],
    )


def test_missing_topic(tmp_path: Path) -> None:
    rules = battery_and("/odom", "nav_msgs/Odometry", "twist", "twist", "linear", "x")
    updates, found = replay(write_ros1(tmp_path / "drive.bag", readings(ROS1)), rules)
    assert codes(found) == ["ROSS601"]
    assert found[0].severity is Severity.WARNING
    assert found[0].primary.span.text == "input speed"
    assert "`/battery` and `/scan`" in found[0].notes[0]
    assert "--topic-map /odom=NAME" in (found[0].help or "")
    assert len(updates) == 10


def test_a_parameter_of_the_node_need_not_be_recorded(tmp_path: Path) -> None:
    """Its default counts (S87), as for a node that was given nothing."""
    rules = battery_and("~gap", "std_msgs/Float64", "data")
    table = tmp_path / "drive.csv"
    table.write_text("time,battery\n0,12\n1,11\n")
    for path in (write_ros1(tmp_path / "drive.bag", readings(ROS1)), table):
        updates, found = replay(path, rules)
        assert codes(found) == []
        assert len(updates) > 1


@pytest.mark.parametrize("topic", ["/scna", "/robot/scan", "/laser"])
def test_missing_topic_with_a_likely_one(tmp_path: Path, topic: str) -> None:
    rules = battery_and(topic, "sensor_msgs/LaserScan", "range_min")
    _, found = replay(write_ros1(tmp_path / "drive.bag", readings(ROS1)), rules)
    assert codes(found) == ["ROSS601"]
    assert f"--topic-map {topic}=/scan" in (found[0].help or "")


def test_every_input_of_a_missing_topic_is_reported(tmp_path: Path) -> None:
    rules = machine(
        [("/battery", "std_msgs/Float32"), ("/odom", "nav_msgs/Odometry")],
        [("battery", 0), ("speed", 1), ("scan", 1)],
        [slot(0, "data"), slot(1, "child_frame_id"), slot(2, "child_frame_id")],
    )
    _, found = replay(write_ros1(tmp_path / "drive.bag", readings(ROS1)), rules)
    assert [finding.primary.span.text for finding in found] == ["input speed", "input scan"]


def test_topic_of_another_type(tmp_path: Path) -> None:
    rules = battery_and("/scan", "sensor_msgs/Imu", "orientation", "x")
    updates, found = replay(write_kind(tmp_path, "mcap", readings(ROS2)), rules)
    assert codes(found) == ["ROSS602"]
    assert "sensor_msgs/LaserScan" in found[0].title
    assert "sensor_msgs/Imu" in found[0].primary.text
    assert len(updates) == 10


def test_topic_never_sent(tmp_path: Path) -> None:
    from rosbags.rosbag2 import StoragePlugin, Writer

    with Writer(tmp_path / "own", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        name = "std_msgs/msg/Float32"
        used = writer.add_connection("/battery", name, typestore=ROS2)
        writer.add_connection("/quiet", name, typestore=ROS2)
        content = ROS2.serialize_cdr(ROS2.types[name](data=1.0), name)
        writer.write(used, START_NS, content)
    rules = battery_and("/quiet", "std_msgs/Float32", "data")
    updates, found = replay(tmp_path / "own", rules)
    assert codes(found) == ["ROSS603"]
    assert len(updates) == 1


@pytest.mark.parametrize(
    ("path", "kind", "expected"),
    [
        (("range_average",), FieldKind.REAL, "a number"),
        (("header", "frame_id"), FieldKind.REAL, "a number"),
        (("range_min",), FieldKind.TEXT, "a string"),
        (("range_min", 0), FieldKind.REAL, "a number"),
        (("ranges",), FieldKind.REAL, "a number"),
        (("header",), FieldKind.REAL, "a number"),
    ],
)
def test_field_that_is_not_recorded(
    tmp_path: Path, path: tuple[str | int, ...], kind: FieldKind, expected: str
) -> None:
    rules = battery_and("/scan", "sensor_msgs/LaserScan", *path, kind=kind)
    updates, found = replay(write_ros1(tmp_path / "drive.bag", readings(ROS1)), rules)
    assert codes(found) == ["ROSS604"]
    assert expected in found[0].title
    assert math.isnan(updates[1].channels[1].slots[1])


def test_array_that_is_not_recorded(tmp_path: Path) -> None:
    rules = machine(
        [("/scan", "sensor_msgs/LaserScan")],
        [("scan", 0)],
        arrays=[Array(0, ("range_min",), 1.0, 0.0, "m")],
    )
    _, found = replay(write_ros1(tmp_path / "drive.bag", readings(ROS1)), rules)
    assert codes(found) == ["ROSS604"]
    assert "an array of numbers" in found[0].title


def test_messages_that_cannot_be_decoded(tmp_path: Path) -> None:
    from rosbags.rosbag1 import Writer

    name = "std_msgs/msg/Float32"
    content = bytes(ROS1.serialize_ros1(ROS1.types[name](data=1.0), name))
    with Writer(tmp_path / "drive.bag") as writer:
        connection = writer.add_connection("/battery", name, typestore=ROS1)
        for index in range(10):
            short = index in (4, 7)
            writer.write(connection, START_NS + index * 10**9, content[:2] if short else content)
    updates, found = replay(tmp_path / "drive.bag")
    assert codes(found) == ["ROSS605"]
    assert "2 of 10" in found[0].title
    assert "4.000 s into" in found[0].notes[0]
    assert len(updates) == 10
    unknown = [math.isnan(update.channels[0].slots[0]) for update in updates]
    assert [index for index in range(10) if unknown[index]] == [4, 7]


def test_nothing_to_replay(tmp_path: Path) -> None:
    rules = machine([("/odom", "nav_msgs/Odometry")], [("speed", 0)], [slot(0, "child_frame_id")])
    with pytest.raises(RecordingError) as caught:
        replay(write_ros1(tmp_path / "drive.bag", readings(ROS1)), rules)
    assert caught.value.diagnostic.code == "ROSS616"
    assert "`/odom`" in caught.value.diagnostic.notes[0]


def test_topic_map_of_a_topic_that_is_not_read(tmp_path: Path) -> None:
    with pytest.raises(RecordingError) as caught:
        replay(write_ros1(tmp_path / "drive.bag", readings(ROS1)), BATTERY, {"/batery": "/b"})
    found = caught.value.diagnostic
    assert found.code == "ROSS607"
    assert found.primary.span.text == "/batery"
    assert found.help == "did you mean `/battery=/b`?"


def test_topic_with_two_types(tmp_path: Path) -> None:
    """Messages of the type that came first are read, the others passed over and counted."""
    name = "std_msgs/msg/Float64"
    other = [("/battery", START_NS + 5, name, ROS1.types[name](data=99.0))]
    path = write_ros1(tmp_path / "drive.bag", readings(ROS1) + other)
    updates, found = replay(path)
    assert codes(found) == ["ROSS608"]
    assert found[0].title == "1 of 11 messages on `/battery` are skipped"
    assert "std_msgs/Float64" in found[0].notes[0]
    assert volts(updates) == [12.0 + i / 2 for i in range(10)]


def test_messages_at_instants_that_cannot_be(tmp_path: Path) -> None:
    late = [("/battery", 2**62 + 5, *battery(ROS2, 99.0))]
    path = write_kind(tmp_path, "mcap", readings(ROS2) + late)
    updates, found = replay(path)
    assert codes(found) == ["ROSS608"]
    assert "outside the range" in found[0].notes[0]
    assert volts(updates) == [12.0 + i / 2 for i in range(10)]
    with open_recording(path) as recording:
        assert recording.end_ns == START_NS + 910_000_000


def test_a_topic_that_is_mapped_to_nothing(tmp_path: Path) -> None:
    """The help names the topic of the rules: the recorded one cannot stand left of `=`."""
    rules = battery_and("/odom", "sensor_msgs/LaserScan", "range_min")
    path = write_ros1(tmp_path / "drive.bag", readings(ROS1))
    _, found = replay(path, rules, {"/odom": "/nothing"})
    assert codes(found) == ["ROSS601"]
    assert "`/nothing` is not in the recording" in found[0].title
    assert found[0].help == "did you mean `/scan`? then add `--topic-map /odom=/scan`"
    assert replay(path, rules, {"/odom": "/scan"})[1] == ()


def test_placeholders_of_all_findings() -> None:
    for template in ALL:
        template.check_placeholders()
    assert len({template.code for template in ALL}) == len(ALL)
