"""The system model of a recording."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.recordings.errors import RecordingError
from rossmarie.recordings.opening import open_recording
from rossmarie.recordings.system_model import write_model
from support.frames import Placed, pose, transforms
from support.recordings import ROS1, START_NS, battery, readings, write_mcap, write_ros1


def test_topics_types_and_rates(tmp_path: Path) -> None:
    path = write_ros1(tmp_path / "outdoor drive-2.bag", readings(ROS1))
    with open_recording(path) as recording:
        text = write_model(recording)
    assert text == (
        "// Written from outdoor drive-2.bag: 0.9 s.\n"
        "system outdoor_drive_2 {\n"
        "    topic /battery : std_msgs/Float32;              // 10 messages, 11.0 Hz\n"
        "    topic /scan : sensor_msgs/LaserScan from laser; // 10 messages, 11.0 Hz\n"
        "}\n"
    )


def test_a_single_message_has_no_rate(tmp_path: Path) -> None:
    found = [*readings(ROS1), ("/once", START_NS, *battery(ROS1, 12.0))]
    with open_recording(write_ros1(tmp_path / "drive.bag", found)) as recording:
        assert "topic /once : std_msgs/Float32;                 // 1 message\n" in write_model(
            recording
        )


@pytest.mark.parametrize(
    ("name", "identifier"), [("2024-05-01", "recording_2024_05_01"), ("å", "recording")]
)
def test_name_of_the_system(tmp_path: Path, name: str, identifier: str) -> None:
    with open_recording(write_ros1(tmp_path / f"{name}.bag", readings(ROS1))) as recording:
        assert f"system {identifier} {{" in write_model(recording)


def test_frames(tmp_path: Path) -> None:
    """Moving frames have the timeout of two of their longest gaps; what rules cannot say is left as
    a comment.
    """

    def at(parent: str, child: str) -> Placed:
        return Placed(parent, child, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))

    turn, pair = (0.0, 0.0, 0.0, 1.0), (at("odom", "base"), at("/base", "arm/tool"))
    found = [
        ("/tf_static", START_NS, *transforms(ROS1, 0, at("base", "camera"), at("a", "x"))),
        ("/tf", START_NS, *transforms(ROS1, 0, *pair)),
        ("/tf", START_NS + 120_000_000, *transforms(ROS1, 0, *pair, at("b", "x"))),
        ("/hand", START_NS, *pose(ROS1, 0, "arm/tool", turn[:3], turn)),
        ("/mark", START_NS, *pose(ROS1, 0, "base", turn[:3], turn)),
        ("/mark", START_NS, *pose(ROS1, 0, "odom", turn[:3], turn)),
    ]
    with open_recording(write_ros1(tmp_path / "drive.bag", found)) as recording:
        text = write_model(recording)
    lines = [line.partition(";")[0].strip() for line in text.splitlines()]
    assert lines[2:9] == [
        "// frame x in a",
        "// frame x in b timeout 0.1 sec",
        'frame "arm/tool" in base timeout 0.3 sec',
        "frame camera in base",
        "frame base in odom timeout 0.3 sec",
        'topic /hand : geometry_msgs/PoseStamped from "arm/tool"',
        "topic /mark : geometry_msgs/PoseStamped",
    ]


SEPARATED = "\n" + "=" * 80 + "\nMSG: "
WHEELS = SEPARATED.join(
    [
        "# m/s\nmy_msgs/Wheel[2] wheels\nstd_msgs/Header header\n",
        "my_msgs/Wheel\nfloat32 speed\n",
        "std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n",
        "builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n",
    ]
)


def one_message(folder: Path, schema: str, definition: str, encoding: str = "ros2msg") -> Path:
    return write_mcap(
        folder / "drive.mcap",
        profile="ros2",
        schema=(schema, encoding, definition),
        channel=("/wheels", "cdr"),
        messages=[(START_NS, b"")],
    )


def test_types_of_ones_own(tmp_path: Path) -> None:
    path = one_message(tmp_path, "my_msgs/msg/Wheels", WHEELS)
    with open_recording(path) as recording:
        hinted = write_model(recording)
        found = recording.definitions()
        complete = write_model(recording, found)
        lacking = write_model(recording, ())
    assert dict(found) == {
        "my_msgs/Wheels": "# m/s\nmy_msgs/Wheel[2] wheels\nstd_msgs/Header header\n",
        "my_msgs/Wheel": "float32 speed\n",
    }
    hint = "    // not in the standard packages: my_msgs/Wheels\n"
    declared = "    topic /wheels : my_msgs/Wheels; // 1 message\n"
    assert hint in hinted
    assert declared in hinted
    assert '    messages "msg";\n' in complete
    assert declared in complete
    assert hint not in complete
    assert hint in lacking
    assert "    // topic /wheels : my_msgs/Wheels; // 1 message\n" in lacking


def test_a_type_that_is_recorded_as_idl(tmp_path: Path) -> None:
    definition = """\
================================================================================
IDL: my_msgs/msg/Wheel
module my_msgs { module msg { struct Wheel { float speed; sequence<double, 3> forces; }; }; };
"""
    path = one_message(tmp_path, "my_msgs/msg/Wheel", definition, "ros2idl")
    with open_recording(path) as recording:
        found = recording.definitions()
    assert dict(found) == {"my_msgs/Wheel": "float32 speed\nfloat64[<=3] forces\n"}


@pytest.mark.parametrize(
    "definition",
    [
        "float32 speed" + SEPARATED + "../../etc/Wheel\nfloat32 speed\n",
        "float32 speed" + SEPARATED + "my_msgs/../Wheel\nfloat32 speed\n",
        "float32 speed speed speed",
        "",
    ],
)
def test_no_definition_is_outside_of_its_folder(tmp_path: Path, definition: str) -> None:
    with open_recording(one_message(tmp_path, "my_msgs/msg/Wheel", definition)) as recording:
        assert set(recording.definitions()) <= {"my_msgs/Wheel"}


def test_what_rules_cannot_name_is_a_comment(tmp_path: Path) -> None:
    path = write_mcap(
        tmp_path / "drive.mcap",
        profile="ros2",
        schema=("nav2_msgs/action/Spin_FeedbackMessage", "ros2msg", ""),
        channel=("/spin/_action/feedback", "cdr"),
        messages=[(START_NS, b"")],
    )
    with open_recording(path) as recording:
        text = write_model(recording)
    expected = "    // topic /spin/_action/feedback : nav2_msgs/action/Spin_FeedbackMessage;"
    assert expected in text


def test_csv_has_no_types(tmp_path: Path) -> None:
    path = tmp_path / "drive.csv"
    path.write_text("time,/a.x\n0,1\n")
    with open_recording(path) as recording, pytest.raises(RecordingError) as caught:
        write_model(recording)
    assert caught.value.diagnostic.code == "ROSS617"
