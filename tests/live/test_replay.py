"""A recording gives the same verdicts in `rossmarie replay` and, played, in the node."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.typesys.store import Typestore

from support.live import Ros
from support.live_cases import PACKAGES
from support.live_cases import rules as rules_of_vehicle
from support.live_replay import replayed, says
from support.recordings import START_NS, Reading, scan, stamped, store_of, write_kind

NEAR = {"ros1": 0.03, "ros2": 0.2}
"""Seconds by which instants may differ: time is reported in steps; and in ROS 2, what is played
comes late on a busy machine.
"""


def test_a_drive_gives_the_same_verdicts(ros: Ros, vehicle: Path, tmp_path: Path) -> None:
    rules = tmp_path / "vehicle.ross"
    rules.write_text(rules_of_vehicle(ros.name), encoding="utf-8")
    kind = {"ros1": "bag", "ros2": "mcap directory"}[ros.name]
    recording = write_kind(tmp_path, kind, list(drive(store_of(kind))))
    folders = (PACKAGES[ros.name],)
    expected = replayed(rules, recording, NEAR[ros.name], message_folders=folders)
    assert len(expected) == 11
    latched = tmp_path / "latched"
    assert says(ros, vehicle, latched, lambda: ros.play(recording), len(expected)) == expected


def drive(store: Typestore) -> Iterator[Reading]:
    """15 s: a slope, something near, a pause, an IMU that falls silent, and the slope again."""
    for tick in range(750):
        at_ns, time_s = START_NS + tick * 20_000_000, tick / 50
        is_on_slope = 1.0 < time_s < 2.0 or 12.0 < time_s < 13.0
        if not 7.0 < time_s < 11.0:
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
