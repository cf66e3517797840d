"""Goals of action servers are cancelled, kept away and sent again."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable

import pytest

from support.live import Ears, Process, Robot, Ros, until
from support.live_cases import ACTIONS

Start = Callable[..., Process]
Grip = Callable[[], Ears]

LEASE = {"ros1": 1.0, "ros2": 15.0}
"""Seconds after which all know that a process was killed; ten are usual in ROS 2."""


@pytest.fixture
def working(robot: Robot, start: Start) -> Robot:
    """A robot whose arm pursues goal 7, with the node."""
    start()
    robot.passes(1.0)
    robot.ask(goal=7)
    until(lambda: robot.heard("/arm") == [["begins", 7]], "the arm begins")
    return robot


@pytest.fixture
def grip(ros: Ros, started: list[Process]) -> Grip:
    """Starts the hand."""

    def grip() -> Ears:
        hand = ros.ears(ACTIONS[ros.name], script="hand.py")
        started.append(hand)
        return hand

    return grip


def follows(robot: Robot, *events: list[object]) -> None:
    """Wait until these are the last that have happened to the arm."""
    until(lambda: robot.heard("/arm")[-len(events) :] == list(events), f"{events}")


def test_a_goal_is_cancelled_and_sent_again(working: Robot) -> None:
    working.set(mode="paused")
    until(lambda: working.heard("/arm")[-1:] == [["is cancelled", 7]], "it is cancelled")
    until(lambda: working.states("freeze") == ["holding"], "the cancellation is confirmed")
    working.set(mode="driving")
    until(lambda: working.heard("/arm")[-1:] == [["begins", 7]], "it is sent again")


def test_goals_of_others_are_kept_away_and_the_last_is_kept(working: Robot) -> None:
    working.set(mode="paused")
    until(lambda: working.states("freeze") == ["holding"], "the cancellation is confirmed")
    working.ask(goal=8)
    time.sleep(0.5)
    assert working.heard("/arm")[-1] != ["begins", 8]
    working.set(mode="driving")
    until(lambda: working.heard("/arm")[-1:] == [["begins", 8]], "the last is sent again")


def test_a_cancellation_that_motion_contradicts_fails(working: Robot) -> None:
    working.set(moving=True, mode="paused")
    until(lambda: working.states("freeze") == ["failed"], "the arm still moves")


def test_a_goal_of_a_rule_takes_the_place_of_another(working: Robot) -> None:
    working.set(recovery="succeeds", mode="touched")
    follows(working, ["begins", 7], ["is cancelled", 7], ["begins", 99], ["succeeds", 99])
    until(lambda: working.states("retract") == ["holding"], "the success is known")
    time.sleep(0.5)
    assert working.heard("/arm")[-1] == ["succeeds", 99]
    working.set(mode="driving")
    follows(working, ["succeeds", 99], ["begins", 7])


def test_a_goal_of_a_rule_that_is_aborted_fails(working: Robot) -> None:
    working.set(recovery="aborts", mode="touched")
    until(lambda: working.states("retract") == ["failed"], "it has failed")
    assert working.states("cry") == ["done"]
    working.set(mode="driving")
    time.sleep(0.5)
    assert working.heard("/arm")[-1] == ["aborts", 99]


def test_a_goal_of_a_rule_that_takes_too_long_is_cancelled(working: Robot) -> None:
    working.set(mode="touched")
    follows(working, ["begins", 99])
    until(lambda: working.states("retract") == ["failed"], "its time is over")
    follows(working, ["begins", 99], ["is cancelled", 99])


def test_a_server_that_is_kept_free_takes_the_goal_of_the_rule(working: Robot) -> None:
    working.set(mode="stuck")
    follows(working, ["is cancelled", 7], ["begins", 99])
    time.sleep(1.0)  # the server tells several times that it pursues a goal
    working.set(recovery="succeeds")
    follows(working, ["begins", 99], ["succeeds", 99])
    working.ask(goal=8)
    time.sleep(0.5)
    assert working.heard("/arm")[-1] != ["begins", 8], "others are still kept away"
    working.set(mode="driving")
    until(lambda: working.heard("/arm")[-1:] == [["begins", 8]], "the last is sent again")


def test_a_release_midway_cancels_the_goal_of_the_rule(working: Robot) -> None:
    working.set(mode="touched")
    follows(working, ["begins", 99])
    working.set(mode="driving")
    follows(working, ["is cancelled", 99], ["begins", 7])


def test_two_rules_that_need_one_server_do_not_disturb_each_other(working: Robot) -> None:
    working.set(mode="paused")
    until(lambda: working.states("freeze") == ["holding"], "the goal is cancelled")
    working.set(recovery="succeeds", mode="both")
    follows(working, ["is cancelled", 7], ["begins", 99], ["succeeds", 99])
    until(lambda: working.states("freeze") == ["waiting"], "the other rule waits")
    working.set(mode="paused")
    until(lambda: working.states("freeze") == ["holding"], "the other rule has the server again")
    time.sleep(0.5)
    assert working.heard("/arm")[-1] == ["succeeds", 99]
    working.set(mode="driving")
    follows(working, ["succeeds", 99], ["begins", 7])


def test_what_a_rule_is_kept_from_cancelling_stops_the_robot_if_it_moves(working: Robot) -> None:
    working.set(moving=True, mode="seized")
    until(lambda: working.states("seize") == ["overdue"], "its time is over")
    assert working.states("stand") == ["holding"]
    working.passes(0.0)
    working.set(moving=False, mode="driving")
    working.passes(1.0)


def test_what_another_rule_has_cancelled_stops_nothing(working: Robot) -> None:
    working.set(mode="seized")
    until(lambda: working.states("freeze") == ["holding"], "the goal is cancelled")
    time.sleep(1.5)
    assert working.states("seize") == ["waiting"]
    working.passes(1.0)


def test_a_goal_for_a_server_that_is_not_there_fails(robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    robot.set(mode="open")
    until(lambda: robot.states("grasp") == ["failed"], "its time is over")
    assert robot.states("cry") == ["done"]


def test_a_goal_of_a_rule_whose_server_dies_fails(robot: Robot, start: Start, grip: Grip) -> None:
    hand = grip()
    start()
    robot.passes(1.0)
    robot.set(mode="gripping")
    until(lambda: hand.heard("/hand") == [["begins", 2]], "it begins")
    hand.end()
    until(lambda: robot.states("grip") == ["failed"], "its server has gone")


@pytest.fixture
def hand(robot: Robot, start: Start, grip: Grip) -> Ears:
    """The hand, which pursues goal 7."""
    found = grip()
    start()
    robot.passes(1.0)
    robot.ask(goal=7, of="/hand")
    until(lambda: found.heard("/hand") == [["begins", 7]], "it begins")
    return found


def test_a_goal_is_sent_again_to_a_server_that_was_started_anew(
    ros: Ros, robot: Robot, hand: Ears, grip: Grip
) -> None:
    robot.set(mode="loose")
    until(lambda: robot.states("loosen") == ["holding"], "it is cancelled")
    hand.end()
    anew = grip()
    robot.set(mode="driving")
    until(lambda: anew.heard("/hand") == [["begins", 7]], "it is sent again")
    time.sleep(LEASE[ros.name])
    assert anew.heard("/hand") == [["begins", 7]]


@pytest.mark.parametrize("how", [signal.SIGSTOP, signal.SIGKILL])
def test_a_server_that_says_nothing_is_not_taken_for_free(
    robot: Robot, hand: Ears, how: int
) -> None:
    hand.running.send_signal(how)
    robot.set(mode="loose")
    until(lambda: robot.states("loosen") == ["failed"], "the cancellation is not confirmed")


def test_a_server_that_dies_while_it_cancels_is_not_taken_for_free(
    robot: Robot, hand: Ears
) -> None:
    hand.ask(obeys=False)
    robot.set(mode="loose")
    time.sleep(0.5)  # the server has said that it is at it
    hand.end()
    until(lambda: robot.states("loosen") == ["failed"], "the cancellation is not confirmed")
