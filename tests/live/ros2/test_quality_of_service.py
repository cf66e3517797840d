"""No publisher is starved silently, however reliable it is."""

from __future__ import annotations

import time
from collections.abc import Callable

from support.live import Process, Robot, until

Start = Callable[..., Process]


def test_inputs_are_subscribed_to_as_they_are_published(robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    wanted = {"/imu/data": "BEST_EFFORT", "/unfil_cmd_vel": "RELIABLE", "/mode": "RELIABLE"}
    until(lambda: robot.ask(reliabilities=list(wanted)) == wanted, "they are matched")
    robot.passes(1.0)


def test_a_publisher_that_is_less_reliable_than_asked_for_is_named(
    robot: Robot, start: Start
) -> None:
    start(**{"qos_overrides./imu/data.subscription.reliability": "reliable"})
    robot.diagnosed("what robot publishes does not come")
    time.sleep(0.5)
    robot.stays_at(0.0)


def test_a_message_that_was_kept_for_late_comers_comes(robot: Robot, start: Start) -> None:
    robot.ask(keep=True)
    time.sleep(0.5)
    start()
    until(lambda: "near" in (robot.state() or {}).get("active", ()), "it is known")
