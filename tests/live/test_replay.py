"""A recording gives the same verdicts in `rossmarie replay` and, played, in the node."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.typesys.store import Typestore

from rossmarie.driver import compile_file
from rossmarie.driver.replay import replay_file
from rossmarie.ir import Verdict
from support.live import Process, Ros, until
from support.live_cases import PACKAGES
from support.live_cases import rules as rules_of_vehicle
from support.parts import A_DRIVE, needs
from support.recordings import START_NS, Reading, scan, stamped, store_of, write_kind
from support.ros1_live import Ros1
from support.shared import HUSKY_DRIVE

HUSKY = Path(__file__).parents[2] / "examples" / "husky" / "husky.ross"

Changes = list[tuple[str, int, Any]]
"""Rules, how they changed, and when, in s of the recording's clock."""

NEAR = 0.2
"""Seconds by which the instants may differ: what is played comes late on a busy machine."""

_LOSSES = "stop_without_position"
"""The rule of HUSKY that goes active when positions pause."""

Play = Callable[[], Process]


def replayed(
    rules: Path,
    recording: Path,
    begin_s: float = 0.0,
    end_s: float = 1e9,
    message_folders: Sequence[Path] = (),
) -> Changes:
    """What `rossmarie replay` says of a part of a recording."""
    replay, _ = replay_file(rules, recording, topic_map={}, message_folders=message_folders)
    return [
        (
            replay.machine.rules[event.rule].name,
            int(event.change),
            pytest.approx(event.at_ns / 1e9, abs=NEAR),
        )
        for event in replay.events
        if isinstance(event, Verdict) and begin_s <= (event.at_ns - replay.start_ns) / 1e9 <= end_s
    ]


def says(ros: Ros, program: Path, latched: Path, play: Play, count: int) -> Changes:
    """What a node says of what is played, `count` verdicts or more."""
    package = program.parent.name
    verdicts = f"/{package}/verdicts"
    with ExitStack() as started:
        node = ros.begin(program, {"state_file": str(latched)}, use_sim_time=True)
        started.callback(node.end)
        ears = ros.ears(verdicts, ros.ros_type(f"{package}/Verdict"))
        started.callback(ears.end)
        ears.connected(verdicts)
        player = play()
        started.callback(player.end)
        assert player.running.wait(150) == 0, player.said()
        until(lambda: len(ears.heard(verdicts)) >= count, f"{count} verdicts")
        return [(told["rule"], told["change"], told["at"]) for told in ears.heard(verdicts)]


def test_a_drive_gives_the_same_verdicts(ros: Ros, tmp_path: Path) -> None:
    rules = tmp_path / "vehicle.ross"
    rules.write_text(rules_of_vehicle(ros.name), encoding="utf-8")
    kind = {"ros1": "bag", "ros2": "mcap directory"}[ros.name]
    recording = write_kind(tmp_path, kind, list(drive(store_of(kind))))
    expected = replayed(rules, recording, message_folders=(PACKAGES[ros.name],))
    assert len(expected) == 11
    latched = tmp_path / "latched"
    assert says(ros, ros.vehicle, latched, lambda: ros.play(recording), len(expected)) == expected


def drive(store: Typestore) -> Iterator[Reading]:
    """14 s: a slope, something near, a pause, an IMU that falls silent, and the slope again."""
    for tick in range(700):
        at_ns, time_s = START_NS + tick * 20_000_000, tick / 50
        is_on_slope = 1.0 < time_s < 2.0 or 11.0 < time_s < 12.0
        if not 7.0 < time_s < 10.0:
            yield "/imu/data", at_ns, *imu(store, tick, 15.0 if is_on_slope else 0.0)
        if tick % 5 == 0:
            yield "/scan", at_ns, *scan(store, tick, [0.2 if 3.0 < time_s < 4.0 else 2.0])
            yield "/mode", at_ns, *mode(store, "paused" if 5.0 < time_s < 6.0 else "driving")


def mode(store: Typestore, text: str) -> tuple[str, Any]:
    name = "std_msgs/msg/String"
    return name, store.types[name](data=text)


def imu(store: Typestore, index: int, pitch: float) -> tuple[str, Any]:
    name, half = "sensor_msgs/msg/Imu", math.radians(pitch) / 2
    vector = store.types["geometry_msgs/msg/Vector3"](x=0.0, y=0.0, z=0.0)
    return name, store.types[name](
        header=stamped(store, index),
        orientation=store.types["geometry_msgs/msg/Quaternion"](
            x=0.0, y=math.sin(half), z=0.0, w=math.cos(half)
        ),
        orientation_covariance=np.zeros(9),
        angular_velocity=vector,
        angular_velocity_covariance=np.zeros(9),
        linear_acceleration=vector,
        linear_acceleration_covariance=np.zeros(9),
    )


@needs(A_DRIVE)
def test_a_part_of_a_real_drive_gives_the_same_verdicts(ros1: Ros1, tmp_path: Path) -> None:
    """At half the speed, and again if need be. A busy machine adds pauses of its own: inputs have a
    second to come, and what is said of late positions is left out.
    """
    rules = tmp_path / "husky.ross"
    patient, count = re.subn(r"timeout 0\.\d+ sec", "timeout 1 sec", HUSKY.read_text("utf-8"))
    assert count == 4
    rules.write_text(patient, encoding="utf-8")
    expected = replayed(rules, HUSKY_DRIVE, 177.0, 214.0)
    assert {rule for rule, _, _ in expected} == {"slow_on_jolts", "slow_on_slopes"}

    def play() -> Process:
        return ros1.play(HUSKY_DRIVE, "--start=177", "--duration=37", "--rate=0.5")

    program = ros1.build(compile_file(rules).machine)
    for attempt in range(3):
        told = says(ros1, program, tmp_path / f"latched {attempt}", play, len(expected))
        said = [verdict for verdict in told if verdict[0] != _LOSSES]
        if said == expected:
            break
    assert said == expected
