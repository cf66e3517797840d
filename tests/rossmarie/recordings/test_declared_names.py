"""Elements by declared names are found in recordings where the length of the array fits (S55)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.typesys.store import Typestore

from rossmarie.ir import Array, FieldKind, Listed
from support.recordings import (
    ROS1,
    ROS2,
    START_NS,
    Reading,
    codes,
    machine,
    replay,
    slot,
    write_kind,
)

NAN = math.nan
KIND = "std_msgs/msg/Float64MultiArray"
ELBOW = Listed(1, 3, "elbow")
READS = machine(
    [("/effort_states", "std_msgs/Float64MultiArray")],
    [("speed", 0)],
    [slot(0, "data", ELBOW), slot(0, "data", Listed(2, 3, "wrist")), slot(0, "data", 1)],
    [Array(0, ("data",), 1.0, 0.0, "")],
)
MESSAGES = [[1.0, 2.0, 3.0], [1.0, 2.0], [1.0, 2.0, 3.0, 4.0], [], [NAN, 5.0, NAN]]
FOUND = [(2.0, 3.0, 2.0), (NAN, NAN, 2.0), (NAN, NAN, 2.0), (NAN, NAN, NAN), (5.0, NAN, 5.0)]


def recorded(ros: Typestore, messages: Sequence[Sequence[float]]) -> list[Reading]:
    return [
        ("/effort_states", START_NS + index * 10**8, KIND, _message(ros, data))
        for index, data in enumerate(messages)
    ]


def _message(ros: Typestore, data: Sequence[float]) -> Any:
    layout = ros.types["std_msgs/msg/MultiArrayLayout"](dim=[], data_offset=0)
    return ros.types[KIND](layout=layout, data=np.array(data, np.float64))


def read(path: Path) -> list[tuple[float, ...]]:
    updates, found = replay(path, READS)
    assert codes(found) == []
    return [tuple(update.channels[0].slots[index] for index in range(3)) for update in updates]


@pytest.mark.parametrize("kind", ["bag", "mcap"])
def test_another_length_leaves_all_elements_unknown(tmp_path: Path, kind: str) -> None:
    path = write_kind(tmp_path, kind, recorded(ROS1 if kind == "bag" else ROS2, MESSAGES))
    np.testing.assert_array_equal(read(path), FOUND)


@pytest.mark.parametrize("kind", ["bag", "mcap"])
def test_a_length_that_never_fits_is_reported_once(tmp_path: Path, kind: str) -> None:
    ros = ROS1 if kind == "bag" else ROS2
    path = write_kind(tmp_path, kind, recorded(ros, [[1.0, 2.0], [1.0], [1.0, 2.0]]))
    _, found = replay(path, READS)
    assert codes(found) == ["ROSS619"]
    assert found[0].title == "`data` on `/effort_states` never has 3 elements (one for each name)"
    assert found[0].notes == ("the array has 1 or 2 elements",)


def test_a_table_has_the_array_in_the_order_of_its_elements(tmp_path: Path) -> None:
    path = tmp_path / "arm.csv"
    names = ",".join(f"/effort_states.data[{index}]" for index in range(4))
    rows = [",".join("" if math.isnan(x) else str(x) for x in row) for row in MESSAGES[:3]]
    rows = [row + "," * (4 - len(each)) for row, each in zip(rows, MESSAGES, strict=False)]
    lines = [f"time,{names}", *(f"{index},{row}" for index, row in enumerate(rows))]
    path.write_text("\n".join(lines) + "\n")
    np.testing.assert_array_equal(read(path), FOUND[:3])


def test_a_table_whose_array_never_fits_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "arm.csv"
    path.write_text("time,speed[0],speed[1]\n0,1,2\n1,3,\n")
    updates, found = replay(path, READS)
    assert codes(found) == ["ROSS619"]
    assert found[0].notes == ("the array has 1 or 2 elements",)
    assert all(math.isnan(update.channels[0].slots[0]) for update in updates)


def test_a_table_may_have_a_column_for_each_name(tmp_path: Path) -> None:
    reads = machine(
        [("/ready", "my_msgs/Ready")],
        [("speed", 0)],
        [slot(0, "data", ELBOW, kind=FieldKind.FLAG), slot(0, "data", Listed(2, 3, "wrist"))],
    )
    path = tmp_path / "arm.csv"
    path.write_text("time,speed.elbow,speed.data.wrist\n0,true,2\n")
    updates, found = replay(path, reads)
    assert codes(found) == []
    assert updates[0].channels[0].slots == {0: 1.0, 1: 2.0}
