"""Frames: a node that hears transforms says of a drive what `rossmarie replay` says: of a pose, and
of points of scans.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pytest
from rosbags.typesys.store import Typestore

from rossmarie.driver import compile_file
from support.frames import Matrix, Placed, matrix, pose, transforms, turn_of
from support.live import Ros, Wanted
from support.live_replay import replayed, says
from support.recordings import START_NS, Reading, store_of, write_kind
from support.scans import message, plain_scan

SUPPORT = Path(__file__).parents[1] / "support"
RULES, SCANS = SUPPORT / "frames.ross", SUPPORT / "scanning.ross"
NEAR = {"ros1": 0.03, "ros2": 0.2}
"""Seconds by which instants may differ: time is reported in steps; and in ROS 2, what is played
comes late on a busy machine.
"""


def needs(_generation: str) -> Sequence[Wanted]:
    """The nodes of rules that see a hand, and scans, from other frames."""
    return [compile_file(each).machine for each in (RULES, SCANS)]


pytestmark = [pytest.mark.builds(by=needs)]


def test_a_drive_gives_the_same_verdicts(
    ros: Ros, programs: Sequence[Path], tmp_path: Path
) -> None:
    kind = {"ros1": "bag", "ros2": "mcap directory"}[ros.name]
    recording = write_kind(tmp_path, kind, list(drive(store_of(kind))))
    expected = replayed(RULES, recording, NEAR[ros.name])
    assert len(expected) == 22
    latched = tmp_path / "latched"
    reported = says(ros, programs[0], latched, lambda: ros.play(recording), len(expected))
    assert reported == expected


def drive(store: Typestore) -> Iterator[Reading]:
    """10 s: the robot drives and turns its head; for a while nobody says where it is, and for
    another one the hand is seen from another frame.
    """
    camera = Placed("head", "camera", (0.1, 0.0, 0.2), turn_of(-math.pi / 2, 0.0, -math.pi / 2))
    yield "/tf_static", START_NS, *transforms(store, 0, camera)
    for tick in range(500):
        at_ns, time_s = START_NS + tick * 20_000_000, tick / 50
        place = Placed("odom", "base_link", (0.2 * time_s, 0.1, 0.0), turn_of(0.0, 0.0, 0.1))
        yaw = 0.5 * math.sin(2.0 * math.pi * time_s / 3.0)
        head = Placed("base_link", "head", (0.0, 0.0, 1.0), turn_of(0.0, 0.2, yaw))
        if not 1.9 < time_s < 2.6:
            yield "/tf", at_ns, *transforms(store, tick, place, head)
        if tick % 3 == 0:
            frame = "head" if 8.2 < time_s < 8.5 else "camera"
            at = (0.3, 0.1, 1.0 + 0.1 * time_s)
            later_ns = 7_000_000 if tick else 0
            yield "/hand", at_ns + later_ns, *pose(store, tick, frame, at, (0.0, 0.0, 0.0, 1.0))


def test_points_of_scans_give_the_same_verdicts(
    ros: Ros, programs: Sequence[Path], tmp_path: Path
) -> None:
    """The laser is fixed to a mast that turns, on a robot that drives."""
    kind = {"ros1": "bag", "ros2": "mcap directory"}[ros.name]
    recording = write_kind(tmp_path, kind, list(scanning_drive(store_of(kind))))
    expected = replayed(SCANS, recording, NEAR[ros.name])
    assert [each[:2] for each in expected] == [each[:2] for each in VERDICTS]
    instants = [float(each[2].expected) - START_NS / 1e9 for each in expected]
    assert instants == pytest.approx([each[2] for each in VERDICTS], abs=0.02)
    latched = tmp_path / "latched"
    reported = says(ros, programs[1], latched, lambda: ros.play(recording), len(expected))
    assert reported == expected


VERDICTS = [
    ("docked", 1, 0.0),
    ("gap", 1, 0.0),
    ("docked", 0, 2.107),
    ("gap", 0, 2.107),
    ("docked", 2, 5.3),  # the frame of the robot is 0.3 s old
    ("gap", 2, 5.3),
    ("docked", 0, 5.807),
    ("gap", 0, 5.807),
    ("docked", 1, 6.507),
    ("gap", 1, 6.507),
    ("near", 1, 6.807),
]
"""Rules that become active, because of what is seen (1) or of what is not (2), and are cleared (0);
and when, in s.
"""
POST = (3.0, 0.0)
UPRIGHT = (0.0, 0.0, 0.0, 1.0)


def test_transforms_that_lie_are_stale(ros: Ros, programs: Sequence[Path], tmp_path: Path) -> None:
    """While nobody knows where the robot is, nothing is known of what it sees."""
    kind = {"ros1": "bag", "ros2": "mcap directory"}[ros.name]
    recording = write_kind(tmp_path, kind, list(lying_drive(store_of(kind))))
    expected = replayed(SCANS, recording, NEAR[ros.name])
    near = [
        (round(float(at.expected) - START_NS / 1e9, 1), is_on)
        for rule, is_on, at in expected
        if rule == "near"
    ]
    assert near == [(at, 2 - 2 * (n % 2)) for n, at in enumerate(STALE_AT_S)]
    latched = tmp_path / "latched"
    reported = says(ros, programs[1], latched, lambda: ros.play(recording), len(expected))
    assert reported == expected


STALE_AT_S = (1.0, 1.5, 2.0, 2.5, 4.0, 4.5, 5.0, 5.5)
"""The times at which an input alternately becomes stale and recovers."""


def lying_drive(store: Typestore) -> Iterator[Reading]:
    """8 s in which a robot stands, and what its transforms say is now and then nonsense."""
    laser = Placed("mast", "laser", (0.1, 0.0, 0.3), UPRIGHT)
    yield "/tf_static", START_NS, *transforms(store, 0, laser)
    mast = Placed("base_link", "mast", (0.0, 0.0, 1.0), UPRIGHT)
    here = Placed("odom", "base_link", (0.0, 0.0, 0.0), UPRIGHT)
    ranges = [5.0, *[math.inf] * 359]
    for tick in range(400):
        at_ns, second = START_NS + tick * 20_000_000, tick / 50
        found = [here, mast]
        if 0.98 < second < 1.48:
            found = [here, mast._replace(turn=(0.0, 0.0, 0.0, 0.0))]
        elif 1.98 < second < 2.48:
            found = [here, mast._replace(origin=(math.nan, 0.0, 0.0))]
        elif 2.98 < second < 3.48:  # not of length 1, which tf2 warns of
            found = [here, mast._replace(turn=(0.0, 0.0, 0.0, 7.0))]
        elif 4.98 < second < 5.48:  # two programs say where the mast is
            found = [here, mast, mast._replace(parent="map")]
        elif 5.98 < second < 6.48:  # others, in a circle, and many
            others = [
                Placed(f"link_{n}", f"link_{(n + 1) % 500}", (1, 2, 3), UPRIGHT) for n in range(500)
            ]
            found = [*others, here, mast, Placed("mast", "odom", (1.0, 0.0, 0.0), UPRIGHT)]
        elif 6.98 < second < 7.48:  # of another robot, or older
            other = Placed("odom", "robot2/mast", (9.0, 0.0, 0.0), UPRIGHT)
            found = [here, other, Placed("/base_link", "/mast", *mast[2:])]
        index = tick if second < 7.0 else 0  # stamps that stand still, of long ago
        yield "/tf", at_ns, *transforms(store, index, *found)
        if tick in (199, 224):
            hung = laser if tick == 224 else laser._replace(parent="base_link")
            yield "/tf_static", at_ns, *transforms(store, tick, hung)
        if tick % 5 == 0:
            scan = message(store, tick, plain_scan(ranges))
            scan.header.frame_id = "laser"
            later_ns = 7_000_000 if tick else 0
            yield "/scan", at_ns + later_ns, "sensor_msgs/msg/LaserScan", scan


def scanning_drive(store: Typestore) -> Iterator[Reading]:
    """10 s: the robot drives towards a post, which is not there for a while. For 0.8 s nobody says
    where the robot is, and for 0.3 s the scans come from another frame.
    """
    laser = Placed("mast", "laser", (0.1, 0.0, 0.3), turn_of(0.0, 0.0, math.pi / 2))
    yield "/tf_static", START_NS, *transforms(store, 0, laser)
    for tick in range(500):
        at_ns, time_s = START_NS + tick * 20_000_000, tick / 50
        base = Placed("odom", "base_link", (0.25 * time_s, 0.0, 0.0), turn_of(0.0, 0.0, 0.0))
        yaw = 0.5 * math.sin(2.0 * math.pi * time_s / 3.0)
        mast = Placed("base_link", "mast", (0.0, 0.0, 1.0), turn_of(0.0, 0.0, yaw))
        yield "/tf", at_ns, *transforms(store, tick, *([] if 5.0 < time_s < 5.8 else [base]), mast)
        if tick % 5 == 0:
            transform: Matrix = matrix(base) @ matrix(mast) @ matrix(laser)
            is_there = not 2.0 < time_s < 6.5
            found = message(store, tick, plain_scan(post_in(transform, is_there)))
            found.header.frame_id = "mast" if 8.2 < time_s < 8.5 else "laser"
            later_ns = 7_000_000 if tick else 0
            yield "/scan", at_ns + later_ns, "sensor_msgs/msg/LaserScan", found


def post_in(transform: Matrix, is_there: bool) -> list[float]:
    """The ranges of a scan, a beam for each degree from -180 deg on. It meets the post and, at its
    first beam, a wall.
    """
    x, y = (np.linalg.inv(transform) @ (*POST, 1.3, 1.0))[:2]
    degree = round(math.degrees(math.atan2(y, x)))
    near = {(degree + each + 180) % 360 for each in (-1, 0, 1)} if is_there else set()
    beams = [math.hypot(x, y) - 0.1 if beam in near else math.inf for beam in range(360)]
    return [5.0, *beams[1:]]
