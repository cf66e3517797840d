"""Goals of action servers are cancelled, kept away and sent again."""

from __future__ import annotations

import time
from collections.abc import Callable

import pytest

from support.ros1_live import Process, Robot, until

Start = Callable[..., Process]


@pytest.fixture
def working(robot: Robot, start: Start) -> Robot:
    """A robot whose arm pursues goal 7, with the node."""
    start()
    until(lambda: robot.commands(0.1)[-1:] == [1.0], "1 m/s passes")
    robot.ask(goal=7)
    until(lambda: robot.heard("/arm") == [["begins", 7]], "the arm begins")
    return robot


def state(robot: Robot) -> list[str]:
    told = robot.state()
    return [task["state"] for task in told["tasks"] if task["action"] == "freeze"]


def test_a_goal_is_cancelled_and_sent_again(working: Robot) -> None:
    working.set(mode="paused")
    until(lambda: working.heard("/arm")[-1:] == [["is cancelled", 7]], "it is cancelled")
    until(lambda: state(working) == ["holding"], "the cancellation is confirmed")
    working.set(mode="driving")
    until(lambda: working.heard("/arm")[-1:] == [["begins", 7]], "it is sent again")


def test_goals_of_others_are_kept_away_and_the_last_is_kept(working: Robot) -> None:
    working.set(mode="paused")
    until(lambda: state(working) == ["holding"], "the cancellation is confirmed")
    working.ask(goal=8)
    until(lambda: working.heard("/arm")[-1:] == [["is cancelled", 8]], "it is cancelled, too")
    time.sleep(0.5)
    assert working.heard("/arm")[-1:] == [["is cancelled", 8]]
    working.set(mode="driving")
    until(lambda: working.heard("/arm")[-1:] == [["begins", 8]], "the last is sent again")


def test_a_cancellation_that_motion_contradicts_fails(working: Robot) -> None:
    working.set(moving=True)
    time.sleep(0.2)
    working.set(mode="paused")
    until(lambda: state(working) == ["failed"], "the arm still moves")
