"""The range scan: what it sees of the room, and of who is in it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from rosbags.typesys import Stores, get_typestore

from heron.experiments.visitor import Leg, Visitor, VisitorWalk
from heron.messages import Message
from heron.robot import Arm, RangeScan, RangeScanParameters
from heron.scene import ArmParameters, PersonParameters, RoomParameters, build_room
from heron.topics import SCAN, InProcess

EXACT = replace(RangeScanParameters(), noise=0.0, dust=0.0, latency=0.0)
REAL = replace(RangeScanParameters(), latency=0.0)


def scans(parameters: RangeScanParameters, place: tuple[float, float], count: int) -> list[Message]:
    """The scans while a person stands at a place."""
    built, person = ArmParameters(), PersonParameters()
    arm = Arm(build_room(RoomParameters(), built, person), built)
    Visitor(arm, VisitorWalk((Leg(0.0, 1.0, place, place),), None), person)
    arm.settle(1)
    carrier = InProcess()
    heard: list[Message] = []
    carrier.subscribe(SCAN, heard.append)
    scan = RangeScan(arm, carrier, np.random.default_rng(5), parameters)
    for index in range(count):
        scan.tick(index * scan.period_ns)
    return heard


def at(scan: Message, degrees: float) -> float:
    return float(scan.ranges[round((degrees + 180) / 0.5)])


def test_it_sees_walls_the_door_and_legs_but_not_the_robot() -> None:
    (scan,) = scans(EXACT, (0.0, 2.0), 1)
    assert len(scan.ranges) == 720
    assert at(scan, -180) == pytest.approx(4.0, abs=0.01)
    assert at(scan, 45) == pytest.approx(4.0 * 2**0.5, abs=0.05)
    assert at(scan, 0) == np.inf, "through the open door"
    assert scan.ranges.min() == pytest.approx(2.0 - 0.1 - 0.07, abs=0.02), "the nearer leg"
    nearest = scan.angle_min + int(np.argmin(scan.ranges)) * scan.angle_increment
    assert 80 < np.degrees(nearest) < 100


def test_its_noise_is_that_of_its_parameters() -> None:
    seen = np.array([at(scan, -180) for scan in scans(REAL, (0.0, 2.0), 400)])
    assert seen.mean() == pytest.approx(4.0, abs=0.01)
    assert seen.std() == pytest.approx(REAL.noise, rel=0.15)


def test_dust_is_a_beam_here_and_there() -> None:
    near = [int(np.sum(scan.ranges < 3.8)) for scan in scans(replace(REAL, dust=1e-3), (5, 5), 100)]
    assert 20 < sum(near) < 120
    quiet = [int(np.sum(scan.ranges < 3.8)) for scan in scans(REAL, (5.0, 5.0), 100)]
    assert max(quiet) < 3, "what the rules take for somebody is more"


def test_scans_are_messages_of_ros_and_come_late() -> None:
    (scan,) = scans(replace(REAL, latency=0.1), (0.0, 2.0), 3)
    assert scan.header.stamp.nanosec == 0
    store = get_typestore(Stores.ROS1_NOETIC)
    name = "sensor_msgs/msg/LaserScan"
    read: Message = store.deserialize_ros1(store.serialize_ros1(scan, name), name)
    assert np.array_equal(read.ranges, scan.ranges)
