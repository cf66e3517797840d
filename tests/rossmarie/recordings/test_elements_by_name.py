"""Joints are found by their names, whatever their order in each message of a recording."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.typesys.store import Typestore

from rossmarie.ir import ByName
from support.recordings import (
    ROS1,
    ROS2,
    START_NS,
    Reading,
    codes,
    machine,
    replay,
    slot,
    stamped,
    write_kind,
)

ELBOW = ByName(("name",), "elbow")
READS = machine(
    [("/joint_states", "sensor_msgs/JointState")],
    [("speed", 0)],
    [slot(0, "velocity", ELBOW), slot(0, "effort", ELBOW), slot(0, "velocity", 0)],
)
MESSAGES: list[tuple[list[str], list[float], list[float]]] = [
    (["shoulder", "elbow"], [1.0, 2.0], [3.0, 4.0]),
    (["elbow", "shoulder"], [5.0, 6.0], [7.0, math.nan]),
    (["shoulder"], [1.0], [1.0]),
    (["elbow", "elbow"], [1.0, 2.0], [1.0, 2.0]),
    (["shoulder", "elbow"], [1.0, 2.0], [3.0]),
    ([], [], []),
    (["shoulder", "elbow"], [math.nan, 9.0], [math.nan, 8.0]),
    (["elbow", "shoulder"], [1.0], [1.0, 2.0, 3.0]),
]
NAN = math.nan
FOUND = [(2.0, 4.0), (5.0, 7.0), (NAN, NAN), (NAN, NAN), (2.0, NAN), (NAN, NAN), (9.0, 8.0)]
FOUND += [(NAN, NAN)]


def joints(
    ros: Typestore, index: int, names: list[str], velocity: list[float], effort: list[float]
) -> Any:
    return ros.types["sensor_msgs/msg/JointState"](
        header=stamped(ros, index),
        name=names,
        position=np.zeros(0),
        velocity=np.array(velocity),
        effort=np.array(effort),
    )


def recorded(ros: Typestore) -> list[Reading]:
    return [
        (
            "/joint_states",
            START_NS + index * 10**8,
            "sensor_msgs/msg/JointState",
            joints(ros, index, *each),
        )
        for index, each in enumerate(MESSAGES)
    ]


def same(left: Sequence[float], right: Sequence[float]) -> bool:
    return np.array_equal(left, right, equal_nan=True)


@pytest.mark.parametrize("kind", ["bag", "mcap"])
def test_each_message_is_read_by_its_own_names(tmp_path: Path, kind: str) -> None:
    path = write_kind(tmp_path, kind, recorded(ROS1 if kind == "bag" else ROS2))
    updates, found = replay(path, READS)
    assert codes(found) == []
    values = [update.channels[0].slots for update in updates]
    assert [same((each[0], each[1]), want) for each, want in zip(values, FOUND, strict=True)] == [
        True
    ] * len(FOUND)


@pytest.mark.parametrize("kind", ["bag", "mcap"])
def test_a_name_that_never_comes_is_reported_with_those_that_do(tmp_path: Path, kind: str) -> None:
    path = write_kind(tmp_path, kind, recorded(ROS1 if kind == "bag" else ROS2))
    misspelt = machine(
        [("/joint_states", "sensor_msgs/JointState")],
        [("speed", 0)],
        [slot(0, "velocity", ByName(("name",), "elbwo")), slot(0, "effort", ELBOW)],
    )
    _, found = replay(path, misspelt)
    assert codes(found) == ["ROSS609"]
    assert "`elbow` and `shoulder`" in found[0].notes[0]
    assert found[0].help == "did you mean `elbow`?"


def test_a_name_that_comes_with_arrays_of_other_lengths_is_there(tmp_path: Path) -> None:
    odd = recorded(ROS1)[-1:]
    _, found = replay(write_kind(tmp_path, "bag", odd), READS)
    assert codes(found) == []


def test_a_recording_without_any_name_says_nothing_of_names(tmp_path: Path) -> None:
    silent = [each for each in recorded(ROS1) if not each[3].name]
    _, found = replay(write_kind(tmp_path, "bag", silent), READS)
    assert codes(found) == []


def test_a_table_has_a_column_for_each_name(tmp_path: Path) -> None:
    path = tmp_path / "arm.csv"
    path.write_text("time,speed.velocity.elbow,speed.effort.elbow,speed.velocity.0\n0,1,2,3\n")
    updates, found = replay(path, READS)
    assert codes(found) == []
    assert updates[0].channels[0].slots == {0: 1.0, 1: 2.0, 2: 3.0}
