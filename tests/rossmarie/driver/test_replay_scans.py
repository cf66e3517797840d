"""A replay of scans says the same with and without a C compiler, and what was put into them."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from rossmarie.driver.pipeline import compile_file
from support.c_compiler import needs_c
from support.recordings import ROS1, ROS2, START_NS, codes, replay, write_kind
from support.replays import reported, without_compiler
from support.scans import LIES, message, random_scan, truthful

RULES = """\
action stop;
input scan = topic /scan : sensor_msgs/LaserScan up to 400 timeout 1 sec;
rule near: if min(scan.ranges[-29.5 deg .. 30.5 deg]) < 0.5 m then { stop; };
rule behind: if any(scan.ranges[150.5 deg .. 209.5 deg] < 2 m) then { stop; };
rule beside: if any(p in scan.points: p.x < -0.2 m and p.y > 0.1 m) then { stop; };
rule bright: if max(p in scan.points: p.intensity) > 300 then { stop; };
rule blind: if count(b in scan.invalid: b.angle in [-30, 30] deg) > 3 then { stop; };
"""
NAME = "sensor_msgs/msg/LaserScan"


@needs_c
@pytest.mark.parametrize("kind", ["bag", "mcap"])
def test_all_engines_say_the_same(tmp_path: Path, kind: str) -> None:
    ros = ROS1 if kind == "bag" else ROS2
    scans = [random_scan(Random(seed)).scan for seed in range(120)]
    sent = [
        ("/scan", START_NS + index * 10**8, NAME, message(ros, index, scan))
        for index, scan in enumerate(scans)
    ]
    recording = write_kind(tmp_path, kind, sent)
    rules = tmp_path / "rules.ross"
    rules.write_text(RULES)
    natively = reported(rules, recording)
    assert len(natively) > 100
    with without_compiler():
        assert reported(rules, recording) == natively


def test_a_replay_says_why_nothing_is_known(tmp_path: Path) -> None:
    scans = [truthful() for _ in LIES]
    for scan, lie in zip(scans, LIES.values(), strict=True):
        lie(scan)
    sent = [
        ("/scan", START_NS + index * 10**8, NAME, message(ROS2, index, scan))
        for index, scan in enumerate([truthful(), *scans])
    ]
    rules = tmp_path / "rules.ross"
    rules.write_text(RULES)
    machine = compile_file(rules).machine
    updates, collector = replay(write_kind(tmp_path, "mcap", sent), machine)
    assert codes(collector) == ["ROSS605"]
    first, *lies = updates
    assert len(first.channels[0].arrays) == len(machine.arrays)
    for update in lies:
        assert not any(map(len, update.channels[0].arrays.values()))
        columns = [index for index, each in enumerate(machine.arrays) if each.list is not None]
        assert not set(columns) & set(update.channels[0].arrays)
