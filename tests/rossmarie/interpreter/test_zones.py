"""S81 and S82: zones, how far they are, and elements of lists in them."""

from __future__ import annotations

import math

import pytest

from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, TruthValue
from support.compiled import machine_of
from support.pose_watch import PoseWatch

HEAD = """
action slow;
input pose = topic /odom : nav_msgs/Odometry .pose.pose timeout 1 sec;
const ahead = 90 cm;
zone box in base_link { box [0.2 m, ahead, -0.4 m, 0.4 m]; }
zone circle in base_link { circle [90, 0] cm radius 0.4 m; }
zone triangle in base_link { polygon [0, 1], [1, 1], [1, 2] m; }
zone all in base_link {
    box [0.2, 0.9, -0.4, 0.4] m;
    circle [0.9, 0] m radius 0.4 m;
    polygon [0, 1], [1, 1], [1, 2] m;
}
"""
FRAMES = {"base_link": 0.0, "odom": -1.0}
"""The numbers of texts: the rules mention one."""
NAN = math.nan
F, T, _, L = TruthValue


def watched(condition: str) -> PoseWatch:
    """A condition on a pose."""
    machine = machine_of(f"{HEAD}rule r: if {condition} then {{ slow; }};")
    return PoseWatch(machine, FRAMES)


def test_s81_a_box_has_its_edges() -> None:
    box = watched("pose in box")
    assert [box.at(x, 0.0) for x in (0.19, 0.2, 0.9, 0.91)] == [F, T, T, F]
    assert [box.at(0.5, y) for y in (-0.41, -0.4, 0.4, 0.41)] == [F, T, T, F]
    assert watched("pose not in box").at(0.5, 0.0) is F


def test_s81_a_circle_has_its_edge() -> None:
    circle = watched("pose.position in circle")
    assert circle.at(0.5, 0.0) is T
    assert circle.at(0.49, 0.0) is F
    assert circle.at(0.9 + 0.28, 0.28) is T
    assert circle.at(0.9 + 0.29, 0.29) is F


def test_s81_a_zone_is_all_its_shapes() -> None:
    zone = watched("pose in all")
    assert [zone.at(0.3, 0.3), zone.at(1.25, 0.0), zone.at(0.9, 1.5)] == [T, T, T]
    assert zone.at(0.3, 0.6) is F


@pytest.mark.parametrize(
    ("zone", "x", "y", "metres"),
    [
        ("box", 1.2, 0.8, 0.5),
        ("box", 0.5, -0.65, 0.25),
        ("box", 0.5, 0.1, 0.0),
        ("circle", 0.9, 1.4, 1.0),
        ("circle", 0.9, 0.3, 0.0),
        ("triangle", 1.5, 1.5, 0.5),
        ("all", 1.5, 0.0, 0.2),
        ("all", 1.5, 1.5, 0.5),
        ("all", -0.3, 0.0, 0.5),
    ],
)
def test_s81_the_distance_from_the_nearest_shape(
    zone: str, x: float, y: float, metres: float
) -> None:
    assert watched(f"distance(pose, {zone}) <= {metres + 1e-9} m").at(x, y) is T
    assert watched(f"distance(pose, {zone}) < {max(metres - 1e-9, 0)} m").at(x, y) is F


def test_s81_another_frame_is_stale() -> None:
    for condition in ("pose in all", "pose not in all", "distance(pose, all) < 1 m"):
        zone = watched(condition)
        assert zone.at(1.0, 1.0, "odom") is L
        assert zone.at(NAN, 1.0) is L


LISTS = """
action slow;
input poses = topic /poses : geometry_msgs/PoseArray up to 5 timeout 5 sec;
input cloud = topic /points : sensor_msgs/PointCloud2 up to 5 timeout 5 sec;
zone box in base_link { box [0, 1, -1, 1] m; }
rule near: if any(p in poses.poses: p in box) then { slow; };
rule far: if all(p in poses.poses: distance(p.position, box) > 1 m) then { slow; };
rule many: if count(p in cloud.points: p not in box) >= 2 then { slow; };
"""


class Seen:
    """Rules on lists of poses and of points, and those of them that are active."""

    def __init__(self) -> None:
        self.machine = machine_of(LISTS)
        self._monitor = Interpreter(self.machine)
        self._at_ns = 0

    def by(self, topic: str, *places: tuple[float, float], frame: str = "base_link") -> set[str]:
        self._at_ns += 1
        channel = next(n for n, each in enumerate(self.machine.channels) if each.topic == topic)
        inputs = {n for n, each in enumerate(self.machine.inputs) if each.channel == channel}
        slots = {n: FRAMES[frame] for n, s in enumerate(self.machine.slots) if s.input in inputs}
        arrays = {
            number: [place["xy".index(str(array.path[-1]))] for place in places]
            for number, array in enumerate(self.machine.arrays)
            if array.input in inputs
        }
        self._monitor.update(self._at_ns, {channel: ChannelValues(slots, arrays)})
        names = [rule.name or "" for rule in self.machine.rules]
        propositions = [
            self._monitor._memory.truth_values[rule.condition] for rule in self.machine.rules
        ]
        return {
            name for name, proposition in zip(names, propositions, strict=True) if proposition is T
        }

    def stale(self) -> set[str]:
        rules = self.machine.rules
        memory = self._monitor._memory.truth_values
        return {rule.name or "" for rule in rules if memory[rule.condition] is L}


def test_s82_elements_lie_in_a_zone() -> None:
    seen = Seen()
    assert seen.by("/poses", (5.0, 0.0), (0.5, 0.5)) == {"near"}
    assert seen.by("/poses", (5.0, 0.0), (0.5, 2.5)) == {"far"}
    assert seen.by("/poses", (5.0, 0.0), (0.5, 1.5)) == set()
    assert seen.by("/points", (5.0, 0.0), (0.5, 0.5), (0.0, -2.0)) == {"many"}
    assert seen.by("/points", (5.0, 0.0), (0.5, 0.5)) == set()


def test_s82_a_list_in_another_frame_is_stale() -> None:
    seen = Seen()
    seen.by("/points", (5.0, 0.0), (0.5, 0.5))
    seen.by("/poses", (5.0, 0.0))
    assert seen.stale() == set()
    seen.by("/poses", (5.0, 0.0), frame="odom")
    assert seen.stale() == {"near", "far"}
    seen.by("/points", (5.0, 0.0), frame="odom")
    assert seen.stale() == {"near", "far", "many"}
