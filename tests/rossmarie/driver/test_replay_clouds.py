"""A replay of clouds says the same with and without a C compiler, and what was put into them."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from support.c_compiler import needs_c
from support.clouds import message, random_cloud
from support.recordings import ROS1, ROS2, START_NS, write_kind
from support.replays import reported, without_compiler

RULES = """\
action stop;
input cloud = topic /points : sensor_msgs/PointCloud2 .points up to 9 timeout 1 sec;
rule near: if any(p in cloud: p.x < 0 m and p.z < 1 m) then { stop; };
rule far: if all(p in cloud: norm(p) > 2 m or p.intensity > 100) then { stop; };
rule bright: if max(p in cloud: p.intensity) > 3 then { stop; };
rule few: if count(p in cloud: true) < 3 then { stop; };
"""


@needs_c
@pytest.mark.parametrize("kind", ["bag", "mcap"])
def test_all_engines_say_the_same(tmp_path: Path, kind: str) -> None:
    ros, name = (ROS1 if kind == "bag" else ROS2), "sensor_msgs/msg/PointCloud2"
    clouds = [random_cloud(Random(seed)).cloud for seed in range(120)]
    sent = [
        ("/points", START_NS + index * 10**8, name, message(ros, index, cloud))
        for index, cloud in enumerate(clouds)
    ]
    recording = write_kind(tmp_path, kind, sent)
    rules = tmp_path / "rules.ross"
    rules.write_text(RULES)
    natively = reported(rules, recording)
    assert len(natively) > 100
    with without_compiler():
        assert reported(rules, recording) == natively
