"""Zones and lists through the Python API and replays: the frame comes with the message."""

from __future__ import annotations

from pathlib import Path
from random import Random
from types import SimpleNamespace

import pytest

from rossmarie import Monitor
from support.c_compiler import needs_c
from support.clouds import message, plain_cloud, random_cloud
from support.engines import ENGINES, load
from support.recordings import ROS1, START_NS, write_kind
from support.replays import reported, without_compiler

pytestmark = needs_c

RULES = """\
action stop;
input poses = topic /poses : geometry_msgs/PoseArray up to 9 timeout 5 sec;
input cloud = topic /points : sensor_msgs/PointCloud2 .points up to 9 timeout 5 sec;
zone stopZone in FRAME {
    box [-0.5, 0.9, -0.4, 0.4] m;
    circle [0.9, 0] m radius 0.4 m;
    polygon [-3, -3], [3, -3], [0, -1] m;
}
rule close: if any(p in poses.poses: p in stopZone) then { stop; };
rule away: if all(p in cloud: distance(p, stopZone) > 0.5 m) then { stop; };
rule many: if count(p in cloud: p in stopZone) >= 2 then { stop; };
"""


def pose(x: float, y: float) -> dict[str, object]:
    return {"position": {"x": x, "y": y, "z": 0.0}}


def cloud(frame: str, *points: tuple[float, float]) -> SimpleNamespace:
    found = plain_cloud([{"x": x, "y": y} for x, y in points])
    found.header = SimpleNamespace(frame_id=frame)
    return found


@pytest.mark.parametrize("engine", ENGINES)
def test_lists_and_clouds_in_a_zone(engine: str, tmp_path: Path) -> None:
    monitor = load(RULES.replace("FRAME", "base_link"), engine, tmp_path)

    def active(at_ns: int, frame: str, place: tuple[float, float]) -> list[str]:
        poses = {"poses": [pose(5.0, 0.0), pose(*place)], "poses.header.frame_id": frame}
        monitor.update(at_ns, {**poses, "cloud": cloud(frame, (5.0, 0.0), place, place)})
        return list(monitor.active)

    assert active(0, "base_link", (1.2, 0.0)) == ["close", "many"]
    assert active(1, "base_link", (1.0, 0.6)) == []
    assert active(2, "base_link", (3.0, 2.0)) == ["away"]
    assert active(3, "odom", (3.0, 2.0)) == ["close", "away", "many"]


def test_a_cloud_without_its_header_is_stale(tmp_path: Path) -> None:
    monitor: Monitor = load(RULES.replace("FRAME", "base_link"), "native", tmp_path)
    monitor.update(0, {"cloud": plain_cloud([{"x": 5.0}]), "poses": []})
    assert {"away", "many"} <= {*monitor.active}


@pytest.mark.parametrize("frame", ["laser", "another"])
def test_all_engines_replay_the_same(tmp_path: Path, frame: str) -> None:
    clouds = [random_cloud(Random(seed)).cloud for seed in range(120)]
    sent = [
        ("/points", START_NS + index * 10**8, "sensor_msgs/msg/PointCloud2",
         message(ROS1, index, each))
        for index, each in enumerate(clouds)
    ]  # fmt: skip
    recording = write_kind(tmp_path, "bag", sent)
    rules = tmp_path / "rules.ross"
    rules.write_text(RULES.replace("FRAME", frame))
    natively = reported(rules, recording)
    assert len(natively) > 20
    with without_compiler():
        assert reported(rules, recording) == natively
