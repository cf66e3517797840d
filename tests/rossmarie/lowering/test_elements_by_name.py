"""Elements by name become slots whose path says which list has the names."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.ir import ByName
from rossmarie.ir import Path as FieldPath
from rossmarie.ir.path import path_text
from support.compiled import machine_of

JOINTS = """
action stop;
input joints = topic /joint_states : sensor_msgs/JointState timeout 0.2 sec;
input effort = topic /joint_states : sensor_msgs/JointState .effort in Nm timeout 0.2 sec;
input arm = topic /arm : my_msgs/Arm timeout 0.2 sec;
input inner = topic /arm : my_msgs/Arm .actual timeout 0.2 sec;
"""
ELBOW = ByName(("name",), "elbow")
OUTER = ByName(("joint_names",), "elbow")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    messages = tmp_path / "my_msgs" / "msg"
    messages.mkdir(parents=True)
    (messages / "Arm.msg").write_text(
        "string[] joint_names\nstring[] other\nbool[] ready\nmy_msgs/Point actual\n"
    )
    (messages / "Point.msg").write_text("string label\nfloat64[] positions\n")
    return tmp_path


@pytest.mark.parametrize(
    ("condition", "path"),
    [
        ('joints["elbow"].velocity > 1 rad/s', ("velocity", ELBOW)),
        ('joints.velocity["elbow"] > 1 rad/s', ("velocity", ELBOW)),
        ('effort["elbow"] > 1 Nm', ("effort", ELBOW)),
        ('(joints["elbow"]).velocity > 1 rad/s', ("velocity", ELBOW)),
        ('arm["elbow"].ready', ("ready", OUTER)),
        ('arm["elbow"].actual.positions > 1 rad', ("actual", "positions", OUTER)),
    ],
)
def test_both_ways_to_write_it_are_one_slot(folder: Path, condition: str, path: FieldPath) -> None:
    rule = f"rule it: if {condition} then {{ stop; }};"
    system = """system s {
        unit sensor_msgs/JointState.velocity = rad/s;
        unit my_msgs/Point.positions = rad;
    }"""
    machine = machine_of(system + JOINTS + rule, message_folders=(folder,))
    assert [slot.path for slot in machine.slots] == [path]


def test_a_path_is_shown_as_it_is_written() -> None:
    assert path_text(("actual", "positions", OUTER)) == '.actual.positions["elbow"]'
    assert path_text(("ranges", 3)) == ".ranges[3]"


@pytest.mark.parametrize(
    ("names", "place"),
    [(["wrist", "elbow"], 1), ([], None), (["elbow", "wrist", "elbow"], None), (["Elbow"], None)],
)
def test_s7_a_name_that_is_missing_or_there_twice_has_no_place(
    names: list[str], place: int | None
) -> None:
    assert ELBOW.place(names, len(names)) == place
