"""The arm's controller: speeds that can be scaled, stops, and gravity-free mode."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron import messages
from heron.experiments.runner import run
from heron.goals import ARM
from heron.robot import Arm, ArmController, ArmControllerParameters
from heron.robot.arm_controller import SPEED_SCALE
from heron.robot.physics import Floats
from heron.robot.trajectory import Trajectory, duration_of
from heron.scene import ArmParameters, TableParameters, build_placing
from heron.topics import ARM_STOP, GRAVITY_FREE, InProcess, Topic

SECOND = 1_000_000_000
OFFSET = np.array([0.2, 0.0, 0.05])


@dataclass
class Bench:
    """An arm with its controller, far above a table, and a place to go to."""

    carrier: InProcess = field(default_factory=InProcess)
    results: list[bool] = field(default_factory=list)
    held: set[Topic] = field(default_factory=set)
    peak: float = 0.0
    period_ns: int = 2_000_000

    def __post_init__(self) -> None:
        built = ArmParameters()
        self.arm = Arm(build_placing(TableParameters(), built), built)
        self.arm.settle(250)
        self.start = self.arm.grasp.copy()
        self.target = self.start + OFFSET
        places = {"there": self.target}
        self.controller = ArmController(self.arm, self.carrier, places, ArmControllerParameters())

    def tick(self, _: int) -> None:
        """Repeat a held command at each tick, as a guard does."""
        for topic in self.held:
            self.carrier.publisher(topic)(messages.Bool(True))
        self.peak = max(self.peak, float(self.arm.efforts.max()))

    def send(self, seconds: float) -> None:
        self.carrier.server(ARM).send({"pose": "there", "seconds": seconds}, self.results.append)

    def pass_time(self, seconds: float, is_over: Callable[[], bool] = lambda: False) -> float:
        """Run for some time. Return the elapsed time (s)."""
        begin_ns = self.arm.now_ns
        run(self.arm, [self, self.controller], begin_ns + round(seconds * SECOND), is_over)
        return (self.arm.now_ns - begin_ns) * 1e-9

    def moved(self, place: Floats) -> float:
        return float(np.linalg.norm(self.arm.grasp - place))


def test_it_is_there_in_time() -> None:
    bench = Bench()
    bench.send(1.0)
    assert bench.pass_time(3.0, lambda: bool(bench.results)) == pytest.approx(1.0, abs=0.1)
    assert bench.results == [True]
    assert bench.moved(bench.target) < 0.006


def test_a_place_that_it_does_not_know_is_not_reached() -> None:
    bench = Bench()
    bench.carrier.server(ARM).send({"pose": "nowhere"}, bench.results.append)
    assert bench.results == [False]


@pytest.mark.parametrize("scale", [0.5, 0.2])
def test_its_speed_can_be_scaled(scale: float) -> None:
    bench = Bench()
    bench.carrier.parameter(SPEED_SCALE).set(scale)
    bench.pass_time(0.5)
    bench.send(1.0)
    took_s = bench.pass_time(10.0, lambda: bool(bench.results))
    assert took_s == pytest.approx(1.0 / scale, rel=0.05)


def test_slower_is_with_less_torque() -> None:
    peaks = []
    for scale in (1.0, 0.4):
        bench = Bench()
        bench.carrier.parameter(SPEED_SCALE).set(scale)
        bench.pass_time(0.5)
        bench.send(0.25)
        bench.pass_time(1.0)
        assert bench.results == [True]
        peaks.append(bench.peak)
    assert peaks[0] > 0.4
    assert peaks[1] < 0.4 * peaks[0]


def test_fingers_hold_what_is_between_them_and_nothing_else() -> None:
    bench = Bench()
    bench.arm.let_go()
    assert bench.arm.take_hold()
    bench.arm.let_go()
    bench.pass_time(0.5)
    bench.carrier.server(ARM).send({"pose": "grasp"}, bench.results.append)
    assert bench.results == [False], "the block has fallen"


def test_a_stop_is_soon_over_way_and_time_and_it_goes_on_afterwards() -> None:
    bench = Bench()
    bench.send(1.0)
    bench.pass_time(0.4)
    bench.held.add(ARM_STOP)
    bench.pass_time(0.3)
    stopped = bench.arm.grasp.copy()
    bench.pass_time(1.0)
    assert bench.moved(stopped) < 0.002
    assert bench.moved(bench.start) > 0.03
    bench.held.clear()
    bench.pass_time(3.0, lambda: bool(bench.results))
    assert bench.results == [True]


def test_gravity_free_it_stays_where_it_is_and_gives_way() -> None:
    bench = Bench()
    bench.held.add(GRAVITY_FREE)
    bench.pass_time(1.0)
    assert bench.moved(bench.start) < 0.01, "it carries itself, and the block"
    bench.arm.data.xfrc_applied[bench.arm.model.body("hand").id, 1] = 15.0
    bench.pass_time(1.0)
    assert bench.moved(bench.start) > 0.05


def test_afterwards_it_goes_on_from_where_it_was_led_without_a_jerk() -> None:
    bench = Bench()
    bench.send(2.0)
    bench.pass_time(0.8)
    bench.held.add(GRAVITY_FREE)
    hand = bench.arm.model.body("hand").id
    bench.arm.data.xfrc_applied[hand, 1] = 15.0
    bench.pass_time(1.0)
    bench.arm.data.xfrc_applied[hand, 1] = 0.0
    bench.pass_time(0.5)
    bench.held.clear()
    bench.peak = 0.0
    led = bench.arm.grasp.copy()
    bench.pass_time(0.3)
    assert bench.moved(led) < 0.03
    bench.pass_time(5.0, lambda: bool(bench.results))
    assert bench.results == [True]
    assert bench.peak < 0.3


def test_a_servo_that_is_stiff_does_not_give_way() -> None:
    bench = Bench()
    bench.arm.data.xfrc_applied[bench.arm.model.body("hand").id, 1] = 15.0
    bench.pass_time(1.0)
    assert bench.moved(bench.start) < 0.01


def test_a_trajectory_keeps_to_its_way_however_slowly_it_is_gone_along() -> None:
    end = np.array([0.3, 0.4, 0.0])
    fast, slow = (Trajectory(np.zeros(3), end, 1.0) for _ in range(2))
    places = [fast.advance(0.01) for _ in range(100)]
    slower = [slow.advance(0.0025) for _ in range(400)]
    assert np.allclose(slower[3::4], places)
    fast.advance(0.01)
    assert fast.is_over
    speeds = np.linalg.norm(np.diff(places, axis=0), axis=1) / 0.01
    assert speeds[0] < 0.05
    assert speeds.max() == pytest.approx(1.875 * 0.5, rel=0.01)


def test_the_usual_duration_keeps_to_speed_and_acceleration() -> None:
    offset = np.array([1.0, 0.0, 0.0])
    assert duration_of(np.zeros(3), offset, 0.5, 100.0) == pytest.approx(3.75)
    assert duration_of(np.zeros(3), offset, 100.0, 1.5) == pytest.approx((5.774 / 1.5) ** 0.5)
    assert duration_of(offset, offset, 0.5, 1.5) > 0
