"""Time that jumps, and time that stands still."""

from __future__ import annotations

import re
import time
from collections.abc import Callable

from support.live import LIMIT, SOME, Process, Robot, until

Start = Callable[..., Process]

VERDICTS = "/vehicle_safety/verdicts"
TIME_JUMP = 3


def jumps(robot: Robot) -> list[str]:
    """The jumps of time that were reported."""
    return [each["cause"] for each in robot.heard(VERDICTS) if each["change"] == TIME_JUMP]


def test_an_exemption_does_not_outlive_a_jump_back(robot: Robot, start: Start) -> None:
    robot.set(clock=1000.0, pitch=15.0)
    start(use_sim_time=True)
    robot.passes(0.2)
    begin = time.monotonic()
    assert robot.call("exempt", rule="tilted", time=5.0, reason="a test drive")["success"]
    robot.passes(1.0)
    robot.set(clock=500.0)
    # Not when 0.2 passes: the bound, which opens along a ramp, begins anew with the jump.
    until(lambda: robot.state().get("exempted") == [], "the exemption is over")
    assert time.monotonic() - begin > 4.5, "the exemption lasts as long as it was given"
    robot.passes(0.2)
    robot.stays_at(0.2)


def test_a_jump_forward_is_reported(robot: Robot, start: Start) -> None:
    robot.set(clock=1000.0)
    start(use_sim_time=True)
    robot.passes(1.0)
    robot.hears_verdicts()
    robot.set(clock=2000.0)
    until(lambda: bool(jumps(robot)), "a verdict tells")
    (reported,) = jumps(robot)
    jump = re.match(r"time jumped forward by (\S+) s", reported)
    # The clock has run on since it was set to 1000 s.
    assert jump is not None, reported
    assert 500.0 < float(jump[1]) <= 1000.0
    until(lambda: robot.call("reset", rule="")["success"], "inputs that were lost are there again")
    robot.passes(1.0)


def test_time_that_runs_evenly_does_not_jump(robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    robot.hears_verdicts()
    robot.stays_at(1.0)
    assert jumps(robot) == []


def test_nothing_passes_while_the_clock_stands_still_and_an_input_is_silent(
    robot: Robot, start: Start
) -> None:
    robot.set(clock=1000.0)
    start(use_sim_time=True)
    robot.passes(1.0)
    robot.set(clock=None, pitch=None)
    robot.passes(0.0)
    robot.stays_at(0.0)
    robot.diagnosed("ROS time stands still")
    stale = "input orientation (/imu/data) is older than its timeout"
    until(lambda: stale in robot.call("why")["text"], "the input is stale")
    robot.set(clock=1010.0, pitch=0.0)
    until(lambda: robot.call("reset", rule="")["success"], "it is safe")
    robot.passes(1.0)


def test_a_clock_may_stand_still_for_as_long_as_is_said(robot: Robot, start: Start) -> None:
    """For a simulation that waits for others."""
    robot.set(clock=1000.0)
    start(use_sim_time=True, clock_timeout=LIMIT)
    robot.passes(1.0)
    robot.set(clock=None)
    time.sleep(4.0)  # longer than the timeout of the input
    robot.stays_at(1.0)


def test_nothing_passes_while_the_clock_stands_still(robot: Robot, start: Start) -> None:
    """Messages that come meanwhile do not count: nobody knows when they are from."""
    robot.set(clock=1000.0)
    start(use_sim_time=True)
    robot.passes(1.0)
    robot.set(clock=None)
    robot.passes(0.0)
    robot.ask(forget="/cmd_vel")
    until(lambda: robot.count("/cmd_vel") > SOME, "0 is sent")
    assert set(robot.speeds()) == {0.0}
    robot.diagnosed("ROS time stands still")
