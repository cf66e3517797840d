"""Skills that ran while something was recorded answer as they do live."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from random import Random

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin
from rosbags.typesys.store import Typestore

from rossmarie.ir import Doing, FieldKind, Machine, Quantity, SkillStep, Slot
from rossmarie.ir.skills import SkillContext, answer
from rossmarie.recordings.errors import RecordingError
from support.recordings import (
    KINDS,
    ROS2,
    START_NS,
    Reading,
    codes,
    machine,
    replay,
    store_of,
    write_kind,
    write_mcap,
    write_ros2,
)
from support.skill_contexts import DIGEST, message, random_context, random_query

TOPIC = "/skill_context"
TYPE = "skill_context_msgs/SkillContext"
PUSH = Doing(
    DIGEST, ("Push",), (("Object", ("skiros.Fragile",)),), written="doing Push(Object: Fragile)"
)
DEPTH = Quantity(DIGEST, ("Push",), "Depth", written="Push.Depth")


def asking(*queries: SkillStep) -> Machine:
    slots = [
        Slot(
            0, (each,), FieldKind.FLAG if isinstance(each, Doing) else FieldKind.REAL, 1.0, 0.0, ""
        )
        for each in queries
    ]
    return machine([(TOPIC, TYPE)], [("mode", 0)], slots)


def recorded(ros: Typestore, contexts: Sequence[SkillContext]) -> list[Reading]:
    return [
        (TOPIC, START_NS + index * 10**8, *message(ros, index, each))
        for index, each in enumerate(contexts)
    ]


def answers(path: Path, queries: Sequence[SkillStep]) -> list[list[float]]:
    updates, found = replay(path, asking(*queries))
    assert codes(found) == []
    return [[update.channels[0].slots[index] for index in range(len(queries))]
            for update in updates]  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_recordings_answer_as_messages_do(tmp_path: Path, kind: str) -> None:
    random = Random(61)
    contexts = [random_context(random) for _ in range(40)]
    queries = [random_query(random) for _ in range(20)]
    path = write_kind(tmp_path, kind, recorded(store_of(kind), contexts))
    expected = [[answer(each, context) for each in queries] for context in contexts]
    np.testing.assert_array_equal(answers(path, queries), expected)


def test_a_recording_without_definitions_is_read(tmp_path: Path) -> None:
    random = Random(62)
    contexts = [random_context(random) for _ in range(9)]
    folder = tmp_path / "drive"
    write_ros2(folder, recorded(ROS2, contexts), StoragePlugin.SQLITE3, version=8)
    expected = [[answer(PUSH, each), answer(DEPTH, each)] for each in contexts]
    np.testing.assert_array_equal(answers(folder, [PUSH, DEPTH]), expected)


def test_another_definition_of_the_message_is_reported(tmp_path: Path) -> None:
    schema = ("skill_context_msgs/msg/SkillContext", "ros2msg", "string digest\nstring[] running\n")
    path = write_mcap(
        tmp_path / "odd.mcap", "ros2", schema, (TOPIC, "cdr"), [(START_NS, bytes(16))]
    )
    updates, found = replay(path, asking(PUSH))
    assert codes(found)[0] == "ROSS604"
    assert "`doing Push(Object: Fragile)`" in found[0].title
    assert all(math.isnan(each.channels[0].slots[0]) for each in updates)


def test_another_export_is_reported_once(tmp_path: Path) -> None:
    contexts = [SkillContext(digest) for digest in ("5b1fb2a09c3e7d41", "", "5b1fb2a09c3e7d41")]
    path = write_kind(tmp_path, "mcap", recorded(ROS2, contexts))
    updates, found = replay(path, asking(PUSH, DEPTH))
    assert codes(found) == ["ROSS624"]
    known = "the rules use the export `c0ffee`, the recording has `5b1fb2a09c3e` and `none`"
    assert found[0].notes == (known,)
    assert all(math.isnan(each) for update in updates for each in update.channels[0].slots.values())
    contexts.append(SkillContext(DIGEST))
    (tmp_path / "mended").mkdir()
    path = write_kind(tmp_path / "mended", "mcap", recorded(ROS2, contexts))
    assert codes(replay(path, asking(PUSH, DEPTH))[1]) == []


def test_a_table_has_a_column_for_each_query(tmp_path: Path) -> None:
    path = tmp_path / "skills.csv"
    path.write_text(
        "time,mode.doing Push(Object: Fragile),/skill_context.Push.Depth\n0,true,\n1,false,0.5\n"
    )
    assert repr(answers(path, [PUSH, DEPTH])) == repr([[1.0, math.nan], [0.0, 0.5]])


def test_a_column_of_two_limits_is_quoted(tmp_path: Path) -> None:
    limits = (("Object", ("skiros.Box",)), ("Target", ("skiros.Box",)))
    asked = replace(PUSH, arguments=limits, written="")
    path = tmp_path / "skills.csv"
    path.write_text(f'time,"mode.{asked}"\n0,1\n1,0\n')
    assert answers(path, [asked]) == [[1.0], [0.0]]


def test_a_column_answers_all_that_ask_the_same(tmp_path: Path) -> None:
    """A rule and an exemption ask by inputs of their own, which are one column."""
    slots = [Slot(index, (PUSH,), FieldKind.FLAG, 1.0, 0.0, "") for index in range(2)]
    both = machine([(TOPIC, TYPE)], [("battery", 0), ("mode", 0)], slots)
    path = tmp_path / "skills.csv"
    path.write_text("time,mode.doing Push(Object: Fragile)\n0,1\n")
    updates, found = replay(path, both)
    assert codes(found) == []
    assert updates[0].channels[0].slots == {0: 1.0, 1: 1.0}
    path.write_text("time,speed,/skill_context.other\n0,1,1\n")
    with pytest.raises(RecordingError, match="ROSS616"):
        replay(path, both)
