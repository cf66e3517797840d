"""Lists of messages in recordings: a column for each field that is read, and what is not known."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.typesys.store import Typestore

from rossmarie.ir import EACH, Array, FieldKind, List, Machine
from support.recordings import (
    KINDS,
    ROS1,
    ROS2,
    START_NS,
    Reading,
    battery,
    codes,
    machine,
    replay,
    stamped,
    write_kind,
)

MOST = 3


def column(*path: str, kind: FieldKind = FieldKind.REAL) -> Array:
    return Array(0, ("status", EACH, *path), 1.0, 0.0, "", None, kind, 0)


def reads(*columns: Array) -> Machine:
    plain = machine([("/status", "diagnostic_msgs/DiagnosticArray")], [("mode", 0)])
    lists = (List(0, ("status",), MOST),)
    return replace(plain, arrays=columns, lists=lists, texts=("motor", "camera"))


READS = reads(column("level"), column("name", kind=FieldKind.TEXT))
MESSAGES: list[list[tuple[int, str]]] = [
    [(0, "motor"), (2, "camera")],
    [],
    [(1, "wheel")],
    [(0, "motor")] * MOST,
    [(0, "motor")] * (MOST + 1),
]
FOUND = [([0.0, 2.0], [0.0, 1.0]), ([], []), ([1.0], [-1.0]), ([0.0] * 3, [0.0] * 3), None]


def diagnostics(ros: Typestore, index: int, statuses: list[tuple[int, str]]) -> Any:
    types = ros.types
    return types["diagnostic_msgs/msg/DiagnosticArray"](
        header=stamped(ros, index),
        status=[
            types["diagnostic_msgs/msg/DiagnosticStatus"](
                level=level, name=name, message="", hardware_id="", values=[]
            )
            for level, name in statuses
        ],
    )


def recorded(ros: Typestore) -> list[Reading]:
    name = "diagnostic_msgs/msg/DiagnosticArray"
    return [
        ("/status", START_NS + index * 10**8, name, diagnostics(ros, index, each))
        for index, each in enumerate(MESSAGES)
    ]


def columns_of(path: Path, of: Machine) -> list[tuple[list[float], ...] | None]:
    updates, found = replay(path, of)
    assert codes(found) == []
    arrays = [update.channels[0].arrays for update in updates]
    return [tuple(map(list, each.values())) if each else None for each in arrays]


@pytest.mark.parametrize("kind", KINDS)
def test_each_list_is_read_and_a_long_one_is_stale(tmp_path: Path, kind: str) -> None:
    path = write_kind(tmp_path, kind, recorded(ROS1 if kind == "bag" else ROS2))
    assert columns_of(path, READS) == FOUND


def test_a_field_that_the_recorded_type_lacks_leaves_the_list_unknown(tmp_path: Path) -> None:
    path = write_kind(tmp_path, "mcap", recorded(ROS2))
    updates, found = replay(path, reads(column("level"), column("severity")))
    assert codes(found) == ["ROSS604"]
    assert [update.channels[0].arrays for update in updates] == [{}] * len(MESSAGES)


def test_a_broken_message_is_no_empty_list(tmp_path: Path) -> None:
    whole = recorded(ROS2)
    name = whole[0][2]
    broken = bytes(ROS2.serialize_cdr(whole[0][3], name))[:-6]
    path = write_kind(tmp_path, "mcap", [*whole[:2], ("/status", whole[2][1], name, broken)])
    updates, found = replay(path, READS)
    assert codes(found) == ["ROSS605"]
    assert [len(update.channels[0].arrays) for update in updates] == [2, 2, 0]


def test_messages_on_other_topics_bring_no_list(tmp_path: Path) -> None:
    name, volts = battery(ROS2, 12.0)
    path = write_kind(tmp_path, "mcap", [*recorded(ROS2), ("/battery", START_NS + 1, name, volts)])
    assert columns_of(path, READS) == FOUND


# --- tables ----------------------------------------------------------------------------------


def table(tmp_path: Path, *rows: str) -> Path:
    path = tmp_path / "drive.csv"
    path.write_text("\n".join(rows) + "\n")
    return path


def test_a_table_without_one_of_the_fields_leaves_the_list_unknown(tmp_path: Path) -> None:
    path = table(tmp_path, "time,mode.status[0].level,mode.status[1].level", "0,0,2", "1,1,")
    updates, found = replay(path, READS)
    assert codes(found) == ["ROSS604"]
    assert [update.channels[0].arrays for update in updates] == [{}] * 2


def test_a_table_has_a_column_for_each_field_of_each_element(tmp_path: Path) -> None:
    path = table(
        tmp_path,
        "time,/status,mode.status[0].level,mode.status[0].name,mode.status[1].level,"
        "mode.status[1].name",
        "0,x,0,motor,2,camera",
        "1,x,,,,",
        "2,,1,wheel,,",
        "3,,,,,",
        "4,,,,1,",
    )
    assert columns_of(path, READS)[:3] == [([0.0, 2.0], [0.0, 1.0]), ([], []), ([1.0], [-1.0])]
    last = columns_of(path, READS)[3]
    assert last is not None
    assert np.array_equal(last, [[np.nan, 1.0], [np.nan, np.nan]], equal_nan=True)
