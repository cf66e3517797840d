"""Nodes that command the robot past the filter are detected and reported."""

from __future__ import annotations

import signal
from collections.abc import Callable

from support.live import Process, Robot, until

Start = Callable[..., Process]
Publish = Callable[..., Process]

PAST = ("/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.9}}")


def test_another_publisher_of_commands_closes_the_filter(
    robot: Robot, start: Start, publish: Publish
) -> None:
    start()
    robot.passes(1.0)
    teleoperation = publish(20, *PAST)
    robot.diagnosed("also publishes this topic and bypasses the filter")
    until(lambda: robot.state().get("blocked") == ["/cmd_vel"], "it is reported")
    assert "also publishes this topic" in robot.call("why")["text"]
    robot.ask(forget="/cmd_vel")
    until(lambda: robot.speeds().count(0.0) > 10, "the node sends 0")
    assert set(robot.speeds()) == {0.0, 0.9}
    teleoperation.end(signal.SIGKILL)
    robot.passes(1.0)


def test_a_rule_acts_on_a_bypass(robot: Robot, start: Start, publish: Publish) -> None:
    start()
    robot.passes(1.0)
    # The siren is sounded once; who is connected later does not hear it.
    robot.connected("/siren")
    assert robot.heard("/siren") == []
    publish(20, *PAST)
    until(lambda: robot.heard("/siren") == [True], "the rule acts")


def test_a_robot_that_does_not_listen_is_reported_of(robot: Robot, start: Start) -> None:
    """Nobody listens to the commands for the arm; the robot has its own name for them."""
    start()
    robot.passes(1.0)
    name = "vehicle_safety: subscribers of /arm_vel"
    assert name not in robot.diagnoses()
    robot.ask(deafen="/arm_vel")
    until(lambda: name in robot.diagnoses(), "it is reported")
