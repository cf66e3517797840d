"""Clouds in recordings: the columns of their points, and why nothing is known of some."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from random import Random
from types import SimpleNamespace
from typing import Any

import pytest
from rosbags.typesys.store import Typestore

from rossmarie.ir import EACH, POINTS, Array, List, Machine
from support.clouds import LIES, MOST, READ, message, plain_cloud, random_cloud, truthful
from support.recordings import (
    KINDS,
    ROS1,
    ROS2,
    START_NS,
    Reading,
    codes,
    machine,
    replay,
    write_kind,
)

NAME = "sensor_msgs/msg/PointCloud2"


def reads(*names: str, most: int = MOST) -> Machine:
    columns = [Array(0, (POINTS, EACH, name), 1.0, 0.0, "", list=0) for name in names]
    lists = [List(0, (POINTS,), most)]
    channel = ("/points", "sensor_msgs/PointCloud2")
    return machine([channel], [("scan", 0)], arrays=columns, lists=lists)


def recorded(ros: Typestore, clouds: list[SimpleNamespace]) -> list[Reading]:
    return [
        ("/points", START_NS + index * 10**8, NAME, message(ros, index, cloud))
        for index, cloud in enumerate(clouds)
    ]


def columns_in(path: Path, of: Machine) -> tuple[list[Any], list[str]]:
    updates, found = replay(path, of)
    arrays = [update.channels[0].arrays for update in updates]
    columns = [[list(each) for each in known.values()] or None for known in arrays]
    return columns, [str(one) for one in found]


@pytest.mark.parametrize("kind", KINDS)
def test_the_points_of_all_layouts(tmp_path: Path, kind: str) -> None:
    made = [random_cloud(Random(seed)) for seed in range(40)]
    clouds = [each.cloud for each in made]
    path = write_kind(tmp_path, kind, recorded(ROS1 if kind == "bag" else ROS2, clouds))
    columns, _ = columns_in(path, reads(*READ))
    assert repr(columns) == repr([each.expected() for each in made])


def test_it_says_why_nothing_is_known_of_clouds(tmp_path: Path) -> None:
    clouds = [truthful(), *(truthful() for _ in LIES)]
    for cloud, lie in zip(clouds[1:], LIES.values(), strict=True):
        lie(cloud)
    path = write_kind(tmp_path, "mcap", recorded(ROS2, clouds))
    updates, found = replay(path, reads(*READ))
    assert [len(update.channels[0].arrays) for update in updates] == [3] + [0] * len(LIES)
    assert codes(found) == ["ROSS605"]
    assert found[0].title == f"{len(LIES)} of {len(clouds)} messages on `/points` cannot be read"


def test_a_field_that_clouds_lack_is_named_and_so_are_those_that_they_have(tmp_path: Path) -> None:
    path = write_kind(tmp_path, "bag", recorded(ROS1, [plain_cloud([{"x": 1.0}])]))
    updates, found = replay(path, reads("x", "intensity"))
    assert [update.channels[0].arrays for update in updates] == [{}]
    (note,) = found[0].notes
    assert "its points have no field `intensity`; they have x, y, z" in str(note)


def test_a_cloud_of_too_many_points_is_stale(tmp_path: Path) -> None:
    clouds = [plain_cloud([{"x": 1.0}] * count) for count in (2, 3)]
    path = write_kind(tmp_path, "bag", recorded(ROS1, clouds))
    columns, found = columns_in(path, reads("x", most=2))
    assert columns == [[[1.0, 1.0]], None]
    assert "it has more than 2 points" in found[0]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (b"string name", b"string nome"),
        (b"uint8 datatype", b"int64 datatype"),
        (b"uint8[] data", b"int16[] data"),
        (b"uint32 height", b"string height"),
    ],
)
def test_what_is_called_a_cloud_and_defined_otherwise_is_none(
    tmp_path: Path, old: bytes, new: bytes
) -> None:
    """A recording brings the definitions of its messages, and may be damaged there."""
    path = write_kind(tmp_path, "bag", recorded(ROS1, [plain_cloud([{"x": 1.0}])]))
    content = path.read_bytes()
    assert old in content
    assert len(old) == len(new)
    path.write_bytes(content.replace(old, new))
    updates, found = replay(path, reads("x"))
    assert not any(update.channels[0].arrays for update in updates)
    assert codes(found)[0] == "ROSS604"
    assert (
        found[0].help
        == "record again with point clouds in the ROS layout of sensor_msgs/PointCloud2"
    )


def test_a_table_has_no_points(tmp_path: Path) -> None:
    path = tmp_path / "drive.csv"
    path.write_text("time,scan.points[0].x,/battery\n0,1,2\n")
    more = machine(
        [("/points", "sensor_msgs/PointCloud2"), ("/battery", "std_msgs/Float32")],
        [("scan", 0), ("battery", 1)],
    )
    cloud = reads("x")
    wanted = replace(more, arrays=cloud.arrays, lists=cloud.lists)
    _, found = replay(path, wanted)
    assert codes(found) == ["ROSS604"]
    assert "a CSV table cannot hold point clouds" in str(found[0].help)
