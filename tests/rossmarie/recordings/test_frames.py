"""Transforms that were recorded reach the channels of the frames that the rules declare (S79)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest
from rosbags.rosbag2 import StoragePlugin

from rossmarie.ir import Channel, Edge, Machine
from rossmarie.recordings.errors import RecordingError
from rossmarie.recordings.model import Update
from support.frames import Placed, transforms
from support.recordings import (
    KINDS,
    ROS2,
    START_NS,
    Reading,
    battery,
    codes,
    machine,
    replay,
    slot,
    store_of,
    write_kind,
    write_ros2,
)

BASE, HEAD = Edge("/tf", "odom", "base"), Edge("/tf", "base", "head")
TURN = (0.0, 0.0, 0.6, 0.8)
MS = 1_000_000
UNKNOWN = pytest.approx(math.nan, nan_ok=True)


def reading(*edges: Edge) -> Machine:
    """A machine that reads the x of each frame, and how it is turned about z."""
    found = machine(
        [(str(edge), "geometry_msgs/Transform") for edge in edges],
        [("speed", index) for index in range(len(edges))],
        [slot(n, *path) for n in range(len(edges)) for path in (X, Z)],
    )
    channels = tuple(
        Channel(each.topic, each.message_type, edge=edge)
        for each, edge in zip(found.channels, edges, strict=True)
    )
    return replace(found, channels=channels)


X, Z = ("translation", "x"), ("rotation", "z")


def at(parent: str, child: str, x: float) -> Placed:
    return Placed(parent, child, (x, 0.0, 0.0), TURN)


def reported(updates: Sequence[Update]) -> list[tuple[int, dict[int, list[float]]]]:
    """The times of transforms, and the numbers of each channel."""
    return [
        (
            (update.at_ns - START_NS) // MS,
            {channel: list(values.slots.values()) for channel, values in update.channels.items()},
        )
        for update in updates
    ]


@pytest.mark.parametrize("kind", KINDS)
def test_a_message_is_for_the_frames_that_it_has(tmp_path: Path, kind: str) -> None:
    ros = store_of(kind)
    messages = [
        (at("odom", "base", 1.0),),
        (at("base", "head", 2.0), at("odom", "base", 3.0), at("base", "arm", 4.0)),
        (at("base", "arm", 5.0),),
        (at("map", "base", 6.0),),
        (at("/odom", "/base", 7.0),),
        (at("odom", "base", 8.0), at("odom", "base", 9.0)),
    ]
    found: list[Reading] = [
        ("/tf", START_NS + index * MS, *transforms(ros, index, *each))
        for index, each in enumerate(messages)
    ]
    updates, findings = replay(write_kind(tmp_path, kind, found), reading(BASE, HEAD))
    assert codes(findings) == []
    assert reported(updates) == [
        (0, {0: [1.0, 0.6]}),
        (1, {0: [3.0, 0.6], 1: [2.0, 0.6]}),
        (3, {0: [UNKNOWN, UNKNOWN]}),
        (4, {0: [7.0, 0.6]}),
        (5, {0: [9.0, 0.6]}),
    ]


def test_s79_a_frame_in_another_parent_is_not_known(tmp_path: Path) -> None:
    """A static transform stays for ever, unless somebody hangs the frame elsewhere."""
    static = Edge("/tf_static", "odom", "base")
    found: list[Reading] = [
        ("/tf_static", START_NS + index * MS, *transforms(ROS2, index, *placed))
        for index, placed in enumerate(
            [
                (at("odom", "base", 1.0),),
                (at("odom", "base", 2.0), at("map", "base", 3.0)),
                (at("map", "base", 4.0), at("odom", "base", 5.0)),
                (at("/map", "/base", 6.0), at("odom", "other", 7.0)),
            ]
        )
    ]
    updates, findings = replay(write_kind(tmp_path, "mcap", found), reading(static))
    assert codes(findings) == []
    assert reported(updates) == [
        (0, {0: [1.0, 0.6]}),
        (1, {0: [UNKNOWN, UNKNOWN]}),
        (2, {0: [5.0, 0.6]}),
        (3, {0: [UNKNOWN, UNKNOWN]}),
    ]


def test_a_frame_that_never_came_is_reported(tmp_path: Path) -> None:
    found: list[Reading] = [("/tf", START_NS, *transforms(ROS2, 0, at("odom", "base", 1.0)))]
    path = write_kind(tmp_path, "mcap", found)
    _, findings = replay(path, reading(BASE, HEAD))
    assert codes(findings) == ["ROSS609"]
    assert findings[0].title == "no message on `/tf` has an element `head in base`"


def test_transforms_of_another_type_are_reported(tmp_path: Path) -> None:
    path = write_kind(tmp_path, "mcap", [("/tf", START_NS, *battery(ROS2, 1.0))])
    with pytest.raises(RecordingError) as raised:
        replay(path, reading(BASE))
    assert "`/tf` was recorded as std_msgs/Float32" in str(raised.value.diagnostic.notes)


def test_other_topics_may_hold_the_transforms(tmp_path: Path) -> None:
    found: list[Reading] = [("/robot/tf", START_NS, *transforms(ROS2, 0, at("odom", "base", 1.0)))]
    path = write_kind(tmp_path, "mcap", found)
    updates, findings = replay(path, reading(BASE), {"/tf": "/robot/tf"})
    assert codes(findings) == []
    assert reported(updates) == [(0, {0: [1.0, 0.6]})]


def test_a_message_that_is_cut_off_is_reported(tmp_path: Path) -> None:
    name, message = transforms(ROS2, 0, at("odom", "base", 1.0))
    whole = bytes(ROS2.serialize_cdr(message, name))
    found: list[Reading] = [
        ("/tf", START_NS, name, whole),
        ("/tf", START_NS + MS, name, whole[: len(whole) // 2]),
    ]
    path = tmp_path / "drive"
    write_ros2(path, found, StoragePlugin.SQLITE3)
    updates, findings = replay(path, reading(BASE))
    assert len(reported(updates)) == 1
    assert codes(findings) == ["ROSS605"]
