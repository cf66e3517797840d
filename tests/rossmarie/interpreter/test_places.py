"""S63 and S64: places of the individuals of a class, and how far they are."""

from __future__ import annotations

import math

import pytest

from rossmarie.ir import TruthValue
from support.compiled import machine_of
from support.pose_watch import PoseWatch
from support.rule_skills import FILE

HEAD = f"""
skills "{FILE}";
action slow;
input pose = topic /odom : nav_msgs/Odometry .pose.pose timeout 1 sec;
"""
FRAMES = {"map": 0.0, "odom": -1.0}
"""The numbers of texts: the rules mention one."""
NAN = math.nan
F, T, _, L = TruthValue


def watched(condition: str) -> PoseWatch:
    """A condition on a pose."""
    machine = machine_of(f"{HEAD}rule r: if {condition} then {{ slow; }};")
    return PoseWatch(machine, FRAMES)


def test_s63_a_point_is_in_a_polygon() -> None:
    corridor = watched("pose in hall.Corridor")
    assert corridor.at(1.0, 1.0) is T
    assert corridor.at(-1.0, 1.0) is F
    assert corridor.at(1.0, 4.0) is F
    assert watched("pose not in hall.Corridor").at(-1.0, 1.0) is T


def test_s63_another_frame_is_stale() -> None:
    corridor = watched("pose in Corridor")
    assert corridor.at(1.0, 1.0, "odom") is L
    assert corridor.at(NAN, 1.0) is L
    assert watched("pose not in Corridor").at(1.0, 1.0, "odom") is L


def test_s63_classes_below_count() -> None:
    assert watched("pose in Corridor").at(22.0, 9.0) is T
    assert watched("pose in SchoolCorridor").at(22.0, 9.0) is T
    assert watched("pose in SchoolCorridor").at(1.0, 1.0) is F


def test_s63_a_point_on_an_edge_is_in_one_polygon() -> None:
    """The school's corridor begins where the other one ends."""
    assert watched("pose in SchoolCorridor").at(20.0, 1.0) is T
    assert watched("pose in Corridor and not (pose in SchoolCorridor)").at(20.0, 1.0) is F
    assert watched("pose in Corridor").at(24.0, 1.0) is F


@pytest.mark.parametrize(
    ("x", "y", "metres"), [(27.0, 1.0, 3.0), (33.0, 5.0, 5.0), (30.0, 1.0, 0.0)]
)
def test_s64_the_distance_from_the_nearest(x: float, y: float, metres: float) -> None:
    """Between the school's corridor and the charger, which is a point."""
    charger = watched(f"distance(pose, Charger) <= {metres} m")
    assert charger.at(x, y) is T
    assert watched(f"distance(pose, Charger) < {metres} m").at(x, y) is F


def test_s64_inside_it_is_zero() -> None:
    corridor = watched("distance(pose, Corridor) == 0 m")
    assert corridor.at(1.0, 1.0) is T
    assert corridor.at(-1.0, 1.0) is F
    assert watched("distance(pose.position, Corridor) == 1 m").at(-1.0, 1.0) is T


def test_s64_another_frame_is_stale() -> None:
    corridor = watched("distance(pose, Corridor) < 1 m")
    assert corridor.at(1.0, 1.0, "odom") is L
    assert corridor.at(1e308, 1.0) is L
