"""The collision monitor: zones, and what they do to a base and to an arm."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron import messages
from heron.experiments import USUAL, HumanEpisode, NavigationEpisode, run_human, run_navigation
from heron.guard import ArmCollisionMonitor, BaseCollisionMonitor
from heron.guard.collision_monitor import BASE_SPEED
from heron.guard.zones import MIN_POINTS, ScannerCircle, ScannerRectangle
from heron.messages import Message
from heron.robot.arm_controller import SPEED_SCALE
from heron.topics import COMMAND, SCAN, InProcess, NodeParameter, Topic
from heron.variants import ExperimentArm, Person, Terrain

MS = 1_000_000
UNFILTERED = Topic("/unfil_cmd_vel", COMMAND.type)


def scan(*points: tuple[float, float]) -> Message:
    """A whole turn in half degrees, with these points (m) in it, and nothing else."""
    ranges = np.full(720, np.inf, dtype=np.float32)
    for x, y in points:
        ranges[round((math.degrees(math.atan2(y, x)) + 180) / 0.5) % 720] = math.hypot(x, y)
    return messages.laser_scan(0, (-math.pi, math.pi, math.radians(0.5)), (0.1, 30.0), ranges)


def ahead(distance: float, count: int = MIN_POINTS) -> tuple[tuple[float, float], ...]:
    """Points right before the robot, so many."""
    return tuple((distance, 0.03 * (index - count / 2)) for index in range(count))


class Bench:
    """A base behind its collision monitor."""

    def __init__(self) -> None:
        self.now_ns = 0
        carrier = InProcess()
        self.monitor = BaseCollisionMonitor(carrier, lambda: self.now_ns)
        self.sent: list[tuple[float, float]] = []
        carrier.subscribe(COMMAND, lambda each: self.sent.append((each.linear.x, each.angular.z)))
        self._scan, self._command = carrier.publisher(SCAN), carrier.publisher(UNFILTERED)

    def after(self, seconds: float, *points: tuple[float, float], is_seen: bool = True) -> None:
        """Time passes, with such a scan at its end."""
        end_ns = self.now_ns + round(seconds * 1e9)
        while self.now_ns < end_ns:
            self.now_ns += 20 * MS
            self.monitor.tick(self.now_ns)
        if is_seen:
            self._scan(scan(*points))
            self.monitor.tick(self.now_ns)

    def command(self, linear: float, angular: float = 0.0) -> tuple[float, float]:
        """The command that the drive gets for one of a program."""
        self._command(messages.twist(linear, angular))
        return self.sent[-1]


def test_points_are_in_a_zone_or_not() -> None:
    x, y = np.array([0.0, 0.74, 0.76, 0.5, -0.1]), np.array([0.0, 0.34, 0.0, 0.36, 0.0])
    assert ScannerRectangle(0.0, 0.75, 0.35).covers(x, y).tolist() == [
        True,
        True,
        False,
        False,
        False,
    ]
    assert ScannerCircle(0.8).covers(x, y).tolist() == [True, False, True, True, True]


def test_nothing_passes_before_the_first_scan() -> None:
    bench = Bench()
    bench.after(0.1, is_seen=False)
    assert bench.command(0.2) == (0.0, 0.0)
    assert not bench.monitor.is_acting, "it waits, and nothing is in its way"
    bench.after(0.1)
    assert bench.command(0.2) == (0.2, 0.0)


def test_the_speed_limit_keeps_the_robot_on_its_path() -> None:
    bench = Bench()
    bench.after(0.1)
    assert bench.command(0.5, 0.4) == pytest.approx((BASE_SPEED, 0.2))
    assert bench.monitor.is_restricting
    assert bench.command(-0.5, 0.0) == pytest.approx((-BASE_SPEED, 0.0))
    assert bench.command(0.2, 0.6) == pytest.approx((0.2, 0.6))
    assert not bench.monitor.is_restricting


def test_zones_slow_it_down_stop_it_and_let_it_go_on() -> None:
    bench = Bench()
    bench.after(0.1, *ahead(1.0))
    assert bench.command(0.2) == pytest.approx((0.06, 0.0))
    assert bench.monitor.active == ("slow_zone",)
    bench.after(0.1, *ahead(0.7))
    assert bench.sent[-1] == (0.0, 0.0), "a stop does not wait for the next command"
    assert set(bench.monitor.active) == {"stop_zone", "slow_zone"}
    bench.after(0.1, *ahead(3.0))
    assert bench.command(0.2) == pytest.approx((0.2, 0.0))
    assert [words for _, words in bench.monitor.reported] == [
        "slow_zone activated",
        "stop_zone activated",
        "stop_zone cleared",
        "slow_zone cleared",
    ]


def test_fewer_points_are_dust() -> None:
    bench = Bench()
    bench.after(0.1, *ahead(0.5, MIN_POINTS - 1))
    assert bench.command(0.2) == pytest.approx((0.2, 0.0))


def test_a_scanner_that_is_silent_stops_the_robot() -> None:
    bench = Bench()
    bench.after(0.1)
    assert bench.command(0.2) == pytest.approx((0.2, 0.0))
    bench.after(1.2, is_seen=False)
    assert bench.sent[-1] == (0.0, 0.0)
    assert bench.monitor.active == ("no_scan",)
    assert bench.monitor.is_acting


def test_an_arm_gets_the_speed_of_the_strictest_zone() -> None:
    carrier, scale = InProcess(), [1.0]
    carrier.declare(
        SPEED_SCALE, NodeParameter(lambda: scale[0], lambda value: scale.insert(0, value))
    )
    monitor = ArmCollisionMonitor(carrier)
    publish = carrier.publisher(SCAN)
    for now_ms, distance, expected in (
        (20, 5.0, 1.0),
        (40, 3.0, 0.3),
        (60, 2.0, 0.0),
        (80, 9, 1.0),
    ):
        publish(scan(*ahead(distance)))
        monitor.tick(now_ms * MS)
        assert scale[0] == expected


# --- in the experiments ----------------------------------------------------------------------


@cache
def drive(arm: ExperimentArm, terrain: Terrain) -> NavigationEpisode:
    return run_navigation(arm, terrain, 3)


@cache
def visit(arm: ExperimentArm) -> HumanEpisode:
    return run_human(arm, Person.INSIDE, 3, (), USUAL)


@pytest.mark.deep
def test_a_range_scan_tells_nothing_of_bumps_and_torque() -> None:
    found = drive(ExperimentArm.COLLISION_MONITOR, Terrain.GENTLE).measures
    without = drive(ExperimentArm.NONE, Terrain.GENTLE).measures
    assert found.peaks["front"] < 0.7 * without.peaks["front"], "because it is slow everywhere"
    assert not found.is_completed
    assert found.time_over_torque > 30
    assert found.interventions == 0


@pytest.mark.deep
def test_on_level_ground_it_is_slow_without_need() -> None:
    found = drive(ExperimentArm.COLLISION_MONITOR, Terrain.FLAT).measures
    assert found.is_completed
    assert found.duration > 1.4 * drive(ExperimentArm.NONE, Terrain.FLAT).measures.duration
    assert found.time_restricted_without_need > 30


def test_an_arm_stands_still_beside_a_person_and_does_not_give_way() -> None:
    found, ours = (
        visit(ExperimentArm.COLLISION_MONITOR).measures,
        visit(ExperimentArm.ROSSMARIE).measures,
    )
    assert found.is_completed
    assert found.time_too_fast == 0.0
    assert found.fastest_near < 0.03
    assert found.gives_way is not None
    assert ours.gives_way is not None
    assert found.gives_way < 0.02 < 0.05 < ours.gives_way
