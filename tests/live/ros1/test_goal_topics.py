"""Goals where they are messages on topics: everybody hears them, and anybody can replace them."""

from __future__ import annotations

import time
from collections.abc import Callable

import pytest

from support.live import Process, Robot, until


@pytest.fixture
def working(robot: Robot, start: Callable[..., Process]) -> Robot:
    """A robot whose arm pursues the goal of a rule instead of goal 7."""
    start()
    robot.passes(1.0)
    robot.ask(goal=7)
    until(lambda: robot.last("/arm") == ["begins", 7], "the arm begins")
    robot.set(mode="touched")
    until(lambda: robot.last("/arm") == ["begins", 99], "the goal of the rule takes its place")
    return robot


def test_a_goal_of_a_rule_that_others_replace_fails(working: Robot) -> None:
    working.ask(goal=8)
    until(lambda: working.states("retract") == ["failed"], "it was preempted")
    until(lambda: working.last("/arm") == ["begins", 8], "the other goal is pursued")


def test_a_goal_that_the_server_has_forgotten_fails(working: Robot) -> None:
    time.sleep(0.5)
    working.ask(lose_goals=True)
    until(lambda: working.states("retract") == ["failed"], "the server was started anew")
    until(lambda: working.last("/arm") == ["is cancelled", 99], "it is cancelled for safety")
    begun, cancelled = (at for at, event in working.ask(heard="/arm") if event[1] == 99)
    assert cancelled - begun < 4.0  # that it has
