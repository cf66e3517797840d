"""Commands are held back by a running node as the rules say."""

from __future__ import annotations

import time
from collections.abc import Callable

from support.live import SOME, Process, Robot, until

Start = Callable[..., Process]


def test_a_command_is_limited_on_a_slope_and_comes_back_along_the_ramp(
    robot: Robot, start: Start
) -> None:
    """Ramp from 0.2 to 1 m/s by 0.5 m/s^2, in 1.6 s. The planner sends 50 commands per second, and
    the node 20 of its own. On a busy machine there are fewer commands, and the distance is longer.
    """
    start()
    robot.passes(1.0)
    robot.set(pitch=15.0)
    robot.passes(0.2)
    robot.stays_at(0.2)
    robot.ask(forget="/cmd_vel")
    begin = time.time()
    robot.set(pitch=0.0)
    until(lambda: robot.last("/cmd_vel") == 1.0, "1 m/s passes again")
    reported = robot.ask(heard="/cmd_vel")
    rising = [speed for _, speed in reported if 0.2 < speed < 1.0]
    assert 0 < len(rising) < 1.2 * 1.6 * (50 + 20)
    assert rising == sorted(rising)
    assert next(at for at, speed in reported if speed == 1.0) - begin > 1.5


def test_a_limit_holds_back_what_was_sent_before(robot: Robot, start: Start) -> None:
    """The planner sends once and is then silent: the robot must not go on at that speed."""
    start()
    robot.passes(1.0)
    robot.set(speed=None)
    robot.ask(forget="/cmd_vel")
    robot.set(pitch=15.0)
    until(lambda: robot.last("/cmd_vel") == 0.2, "the last command is sent again, bounded")


def test_a_command_with_a_header_is_limited_too(robot: Robot, start: Start) -> None:
    start()
    robot.set(arm_speed=1.0)
    until(lambda: robot.last("/arm_vel") == ["tool", 1.0], "it passes as it is")
    robot.set(pitch=15.0)
    until(lambda: robot.last("/arm_vel") == ["tool", 0.1], "its speed is bounded")


def test_a_blocked_topic_carries_zeros_without_any_command(robot: Robot, start: Start) -> None:
    robot.set(speed=None, pitch=None)
    start()
    until(lambda: bool(robot.state()), "the node runs")
    robot.ask(forget="/cmd_vel")
    until(lambda: robot.count("/cmd_vel") >= 2 * SOME, "it sends")
    reported = robot.ask(heard="/cmd_vel")[: 2 * SOME]
    assert {speed for _, speed in reported} == {0.0}
    assert reported[-1][0] - reported[0][0] > SOME / 20 / 2, (
        "20 in a second, or twice that after a pause"
    )


def test_a_command_of_a_rule_takes_the_place_of_the_planners(robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    robot.set(near=True)
    robot.passes(-0.05)  # half of -0.1 m/s
    robot.stays_at(-0.05)
    robot.set(near=False)
    robot.passes(1.0)


def test_what_is_not_finite_becomes_zero(robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    robot.set(speed="nan")
    robot.passes(0.0)
    robot.stays_at(0.0)
    robot.diagnosed("not finite")
    robot.set(speed=1.0)
    robot.passes(1.0)


def test_a_silent_sensor_stops_and_names_itself(robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    robot.set(pitch=None)
    robot.passes(0.0)
    robot.stays_at(0.0)
    assert "input orientation (/imu/data) is older than its timeout" in robot.call("why")["text"]
