"""Recordings of robots that nobody has written rules for yet."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from typing import NamedTuple

from rosbags.typesys.store import Typestore

from support.frames import Placed, transforms
from support.made_messages import made
from support.recordings import START_NS, Reading

UPRIGHT = {"orientation__w": 1.0}


class Spoken(NamedTuple):
    """The messages on a topic: their type, how often they come, and their fields."""

    topic: str
    kind: str
    hz: float
    given: Mapping[str, object]


def scan(count: int = 181, half: float = math.pi / 2) -> dict[str, object]:
    """The fields of a scan in which the nearest thing is 2 m away."""
    return {
        "angle_min": -half,
        "angle_max": half,
        "angle_increment": 2 * half / (count - 1),
        "range_min": 0.1,
        "range_max": 30.0,
        "ranges": [2.0, *[5.0] * (count - 1)],
    }


def joints(names: Sequence[str]) -> dict[str, object]:
    """The fields of joints that move and bear something."""
    count = len(names)
    return {
        "name": list(names),
        "position": [0.5] * count,
        "velocity": [-1.0] * count,
        "effort": [20.0] * count,
    }


BASE = (
    Spoken("/odom", "nav_msgs/Odometry", 20, {"twist__twist__linear__x": 0.5}),
    Spoken("/imu/data", "sensor_msgs/Imu", 50, UPRIGHT),
    Spoken("/scan", "sensor_msgs/LaserScan", 10, scan()),
    Spoken("/cmd_vel", "geometry_msgs/Twist", 10, {"linear__x": 0.5}),
)
ARM_JOINTS = [f"arm_joint_{number}" for number in range(1, 8)]
ARM = (
    Spoken("/joint_states", "sensor_msgs/JointState", 100, joints(ARM_JOINTS)),
    Spoken("/wrench", "geometry_msgs/WrenchStamped", 100, {"wrench__force__z": -12.0}),
    Spoken("/flange", "geometry_msgs/Wrench", 100, {"force__z": 3.0}),
    Spoken("/servo/delta_twist_cmds", "geometry_msgs/TwistStamped", 50, {"twist__linear__x": 0.1}),
)
PARTS = (
    Spoken("/battery", "sensor_msgs/BatteryState", 2, {"percentage": 0.6, "voltage": 25.0}),
    Spoken("/motor/temperature", "sensor_msgs/Temperature", 2, {"temperature": 41.0}),
    Spoken("/diagnostics", "diagnostic_msgs/DiagnosticArray", 2, {}),
    Spoken("/hardware/diagnostics", "diagnostic_msgs/DiagnosticArray", 2, {}),
)


def drive(
    store: Typestore, spoken: Sequence[Spoken], seconds: float = 5.0, pause: float = 0.0
) -> list[Reading]:
    """A recording in which each topic speaks regularly. In the middle all fall silent for `pause`
    seconds.
    """
    return sorted(
        chain.from_iterable(_said(store, each, seconds, pause) for each in spoken),
        key=lambda reading: reading[1],
    )


def _said(store: Typestore, spoken: Spoken, seconds: float, pause: float) -> Iterator[Reading]:
    name = spoken.kind.replace("/", "/msg/")
    for index in range(max(2, int(seconds * spoken.hz))):
        at_s = index / spoken.hz
        at_s += pause if at_s > seconds / 2 else 0.0
        message = made(store, spoken.kind, **spoken.given)
        if hasattr(message, "header"):
            message.header.frame_id = "sensor"
        yield spoken.topic, START_NS + round(at_s * 1e9), name, message


def moving(store: Typestore, seconds: float = 5.0) -> list[Reading]:
    """The transforms of a base in its odometry, ten times a second."""
    place = Placed("odom", "base_link", (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    return [
        ("/tf", START_NS + index * 100_000_000, *transforms(store, index, place))
        for index in range(int(seconds * 10))
    ]
