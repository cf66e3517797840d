"""Frames: a node that hears transforms says of a drive what `rossmarie replay` says."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from rosbags.typesys.store import Typestore

from rossmarie.driver import compile_file
from support.frames import Placed, pose, transforms, turn_of
from support.live import Ros, Wanted
from support.live_replay import replayed, says
from support.recordings import START_NS, Reading, store_of, write_kind

RULES = Path(__file__).parents[1] / "support" / "frames.ross"
NEAR = {"ros1": 0.03, "ros2": 0.2}
"""Seconds by which instants may differ: time is told in steps; and in ROS 2, what is played comes
late on a busy machine.
"""


def needs(_generation: str) -> Sequence[Wanted]:
    """The node of rules that see a hand from other frames."""
    return [compile_file(RULES).machine]


pytestmark = [pytest.mark.builds(by=needs)]


def test_a_drive_gives_the_same_verdicts(
    ros: Ros, programs: Sequence[Path], tmp_path: Path
) -> None:
    kind = {"ros1": "bag", "ros2": "mcap directory"}[ros.name]
    recording = write_kind(tmp_path, kind, list(drive(store_of(kind))))
    expected = replayed(RULES, recording, NEAR[ros.name])
    assert len(expected) == 22
    latched = tmp_path / "latched"
    told = says(ros, programs[0], latched, lambda: ros.play(recording), len(expected))
    assert told == expected


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
