"""A recording gives the same verdicts in `rossmarie replay` and, played by rosbag, in the node."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rossmarie.driver import compile_file
from rossmarie.driver.replay import replay_file
from rossmarie.ir import Verdict
from support.live import Process, until
from support.live_cases import rules as rules_of_vehicle
from support.recordings import ROS1, START_NS, Reading, scan, stamped, write_ros1
from support.ros1_live import Ros1

HUSKY = Path(__file__).parents[3] / "examples" / "husky" / "husky.ross"
DRIVE = Path(__file__).parents[4] / "shared" / "data" / "husky_outdoor.bag"

Changes = list[tuple[str, int]]
"""Rules, and how they changed."""


def replayed(rules: Path, recording: Path, begin_s: float = 0.0, end_s: float = 1e9) -> Changes:
    """What `rossmarie replay` says of a part of a recording."""
    replay, _ = replay_file(rules, recording, topic_map={})
    return [
        (replay.machine.rules[event.rule].name, int(event.change))
        for event in replay.events
        if isinstance(event, Verdict) and begin_s <= (event.at_ns - replay.start_ns) / 1e9 <= end_s
    ]


@pytest.fixture
def play(ros1: Ros1, tmp_path: Path) -> Callable[..., Changes]:
    """Plays a recording into a node; gives what the node says, `count` verdicts or more."""

    def play(program: Path, recording: Path, count: int, *options: str) -> Changes:
        verdicts = f"/{program.name}/verdicts"
        latched = str(tmp_path / "latched")
        node = ros1.begin(program, {"state_file": latched}, use_sim_time=True)
        ears = ros1.ears(verdicts, f"{program.name}/Verdict")
        command = [
            "/usr/bin/rosbag",
            "play",
            "--quiet",
            "--clock",
            "--hz=500",
            "--wait-for-subscribers",
        ]
        try:
            ears.connected(verdicts)
            player = Process([*command, *options, str(recording)], ros1.variables, tmp_path / "log")
            try:
                assert player.running.wait(150) == 0
            finally:
                player.end()
            until(lambda: len(ears.heard(verdicts)) >= count, f"{count} verdicts")
            return [(told["rule"], told["change"]) for told in ears.heard(verdicts)]
        finally:
            ears.end()
            node.end()

    return play


def test_a_drive_gives_the_same_verdicts(
    ros1: Ros1, play: Callable[..., Changes], tmp_path: Path
) -> None:
    rules = tmp_path / "vehicle.ross"
    rules.write_text(rules_of_vehicle(), encoding="utf-8")
    recording = write_ros1(tmp_path / "drive.bag", list(drive()))
    expected = replayed(rules, recording)
    assert len(expected) == 11
    assert play(ros1.vehicle, recording, len(expected)) == expected


def drive() -> Iterator[Reading]:
    """14 s: a slope, something near, a pause, an IMU that falls silent, and the slope again."""
    for tick in range(700):
        at_ns, time_s = START_NS + tick * 20_000_000, tick / 50
        is_on_slope = 1.0 < time_s < 2.0 or 11.0 < time_s < 12.0
        if not 7.0 < time_s < 9.0:
            yield "/imu/data", at_ns, *imu(tick, 15.0 if is_on_slope else 0.0)
        if tick % 5 == 0:
            yield "/scan", at_ns, *scan(ROS1, tick, [0.2 if 3.0 < time_s < 4.0 else 2.0])
            yield "/mode", at_ns, *mode("paused" if 5.0 < time_s < 6.0 else "driving")


def mode(text: str) -> tuple[str, Any]:
    name = "std_msgs/msg/String"
    return name, ROS1.types[name](data=text)


def imu(index: int, pitch: float) -> tuple[str, Any]:
    name, half = "sensor_msgs/msg/Imu", math.radians(pitch) / 2
    vector = ROS1.types["geometry_msgs/msg/Vector3"](x=0.0, y=0.0, z=0.0)
    return name, ROS1.types[name](
        header=stamped(ROS1, index),
        orientation=ROS1.types["geometry_msgs/msg/Quaternion"](
            x=0.0, y=math.sin(half), z=0.0, w=math.cos(half)
        ),
        orientation_covariance=np.zeros(9),
        angular_velocity=vector,
        angular_velocity_covariance=np.zeros(9),
        linear_acceleration=vector,
        linear_acceleration_covariance=np.zeros(9),
    )


@pytest.mark.skipif(not DRIVE.is_file(), reason=f"the recording {DRIVE.name} is not there")
def test_a_part_of_a_real_drive_gives_the_same_verdicts(
    ros1: Ros1, play: Callable[..., Changes]
) -> None:
    """At half the speed: where the odometry pauses, a busy machine must not add to its pause."""
    program = ros1.build(compile_file(HUSKY).machine)
    expected = replayed(HUSKY, DRIVE, 177.0, 214.0)
    assert len(expected) == 8
    played = ["--start=177", "--duration=37", "--rate=0.5"]
    assert play(program, DRIVE, len(expected), *played) == expected
