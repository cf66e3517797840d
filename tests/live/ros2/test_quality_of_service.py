"""No publisher is starved silently, however reliable it is."""

from __future__ import annotations

import time
from collections.abc import Callable

from support.live import Process, Robot, until

Start = Callable[..., Process]
Publish = Callable[..., Process]


def test_inputs_are_subscribed_to_as_they_are_published(robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    wanted = {"/imu/data": "BEST_EFFORT", "/unfil_cmd_vel": "RELIABLE", "/mode": "RELIABLE"}
    until(lambda: robot.ask(reliabilities=list(wanted)) == wanted, "they are matched")
    robot.passes(1.0)


def test_a_less_reliable_publisher_is_heard_beside_a_reliable_one(
    robot: Robot, start: Start, publish: Publish
) -> None:
    start()
    robot.passes(1.0)
    publish(10, "/imu/data", "sensor_msgs/Imu", "{orientation: {y: 0.13, w: 0.99}}")
    verdicts = "/vehicle_safety/verdicts"
    until(lambda: bool(robot.heard(verdicts)), "the reliable one is heard")
    time.sleep(3.0)  # the node looks at its publishers every 2 s
    robot.set(pitch=40.0)
    robot.passes(0.0)


def test_a_publisher_that_is_less_reliable_than_asked_for_is_named(
    robot: Robot, start: Start
) -> None:
    start(**{"qos_overrides./imu/data.subscription.reliability": "reliable"})
    robot.diagnosed("no message arrives from robot")
    time.sleep(0.5)
    robot.stays_at(0.0)


def test_a_message_that_was_kept_for_late_comers_comes(robot: Robot, start: Start) -> None:
    robot.ask(keep="scan")
    time.sleep(0.5)
    start()
    until(lambda: "near" in robot.state().get("active", ()), "it is known")


def test_a_command_that_was_kept_for_late_comers_does_not_come(robot: Robot, start: Start) -> None:
    robot.set(speed=None)
    robot.ask(keep="command")
    start()
    until(lambda: robot.state().get("open", False), "commands may pass")
    assert 0.7 not in robot.commands(3.0)
    robot.set(speed=0.7)
    robot.passes(0.7)
