"""No publisher is starved silently, however reliable it is."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from support.live import Process, Robot, until
from support.ros2_live import Ros2


@pytest.fixture
def robot(ros2: Ros2) -> Iterator[Robot]:
    """A robot whose IMU is published with best effort, and whose planner is reliable."""
    found = ros2.robot()
    try:
        found.set(pitch=0.0, speed=1.0)
        yield found
    finally:
        found.end()


def test_inputs_are_subscribed_to_as_they_are_published(
    ros2: Ros2, robot: Robot, started: list[Process], tmp_path: Path
) -> None:
    started.append(ros2.start({"state_file": str(tmp_path / "latched")}))
    robot.passes(1.0)
    wanted = {"/imu/data": "BEST_EFFORT", "/unfil_cmd_vel": "RELIABLE", "/mode": "RELIABLE"}
    until(lambda: robot.ask(reliabilities=list(wanted)) == wanted, "they are matched")
    robot.passes(1.0)


def test_a_publisher_that_is_less_reliable_than_asked_for_is_named(
    ros2: Ros2, robot: Robot, started: list[Process], tmp_path: Path
) -> None:
    asked = {"qos_overrides./imu/data.subscription.reliability": "reliable"}
    started.append(ros2.start({"state_file": str(tmp_path / "latched"), **asked}))
    robot.diagnosed("what robot publishes does not come")
    time.sleep(0.5)
    robot.stays_at(0.0)


def test_a_message_that_was_kept_for_late_comers_comes(
    ros2: Ros2, robot: Robot, started: list[Process], tmp_path: Path
) -> None:
    robot.ask(keep=True)
    time.sleep(0.5)
    started.append(ros2.start({"state_file": str(tmp_path / "latched")}))
    until(lambda: "near" in (robot.state() or {}).get("active", ()), "it is known")
