"""S63 and S64: places of the things of a class, and how far they are."""

from __future__ import annotations

import math

import pytest

from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, TruthValue
from support.compiled import machine_of
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


class Watched:
    """A condition on a pose, and what it is where the robot is."""

    def __init__(self, condition: str) -> None:
        self.machine = machine_of(f"{HEAD}rule r: if {condition} then {{ slow; }};")
        self._monitor = Interpreter(self.machine)
        self._at_ns = 0

    def at(self, x: float, y: float, frame: str = "map") -> TruthValue:
        self._at_ns += 1
        known = {"x": x, "y": y, "frame_id": FRAMES[frame]}
        slots = {n: known[str(slot.path[-1])] for n, slot in enumerate(self.machine.slots)}
        self._monitor.update(self._at_ns, {0: ChannelValues(slots)})
        found = self._monitor._memory.truths[self.machine.rules[0].condition]
        assert found is not None
        return found


def test_s63_a_point_is_in_a_polygon() -> None:
    corridor = Watched("pose in hall.Corridor")
    assert corridor.at(1.0, 1.0) is T
    assert corridor.at(-1.0, 1.0) is F
    assert corridor.at(1.0, 4.0) is F
    assert Watched("pose not in hall.Corridor").at(-1.0, 1.0) is T


def test_s63_another_frame_is_lost() -> None:
    corridor = Watched("pose in Corridor")
    assert corridor.at(1.0, 1.0, "odom") is L
    assert corridor.at(NAN, 1.0) is L
    assert Watched("pose not in Corridor").at(1.0, 1.0, "odom") is L


def test_s63_classes_below_count() -> None:
    assert Watched("pose in Corridor").at(22.0, 9.0) is T
    assert Watched("pose in SchoolCorridor").at(22.0, 9.0) is T
    assert Watched("pose in SchoolCorridor").at(1.0, 1.0) is F


def test_s63_a_point_on_an_edge_is_in_one_polygon() -> None:
    """The school's corridor begins where the other one ends."""
    assert Watched("pose in SchoolCorridor").at(20.0, 1.0) is T
    assert Watched("pose in Corridor and not (pose in SchoolCorridor)").at(20.0, 1.0) is F
    assert Watched("pose in Corridor").at(24.0, 1.0) is F


@pytest.mark.parametrize(
    ("x", "y", "metres"), [(27.0, 1.0, 3.0), (33.0, 5.0, 5.0), (30.0, 1.0, 0.0)]
)
def test_s64_the_distance_from_the_nearest(x: float, y: float, metres: float) -> None:
    """Between the school's corridor and the charger, which is a point."""
    charger = Watched(f"distance(pose, Charger) <= {metres} m")
    assert charger.at(x, y) is T
    assert Watched(f"distance(pose, Charger) < {metres} m").at(x, y) is F


def test_s64_inside_it_is_zero() -> None:
    corridor = Watched("distance(pose, Corridor) == 0 m")
    assert corridor.at(1.0, 1.0) is T
    assert corridor.at(-1.0, 1.0) is F
    assert Watched("distance(pose.position, Corridor) == 1 m").at(-1.0, 1.0) is T


def test_s64_another_frame_is_lost() -> None:
    corridor = Watched("distance(pose, Corridor) < 1 m")
    assert corridor.at(1.0, 1.0, "odom") is L
    assert corridor.at(1e308, 1.0) is L
