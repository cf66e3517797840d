"""Parameters of nodes are set and controllers are switched, and both are undone."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from support.live import Process, Robot, until

Start = Callable[..., Process]


def is_set(robot: Robot, value: float) -> None:
    """Wait until the planner works with this value."""
    until(lambda: robot.heard("/planner/double_")[-1:] == [value], f"the parameter is {value}")


@pytest.fixture
def driving(robot: Robot, start: Start) -> Robot:
    """A robot that drives, with the node."""
    start()
    robot.passes(1.0)
    return robot


@pytest.fixture
def planned(driving: Robot) -> Robot:
    """A robot with a planner, whose parameter is 3."""
    driving.ask(offer="planner")
    is_set(driving, 3.0)
    return driving


@pytest.fixture
def controlled(driving: Robot) -> Robot:
    """A robot with a controller manager."""
    driving.ask(offer="controllers")
    return driving


# --- parameters ----------------------------------------------------------------------------------


def test_a_parameter_is_set_and_has_its_old_value_again(planned: Robot) -> None:
    planned.set(mode="slippery")
    is_set(planned, 0.5)
    until(lambda: planned.states("careful") == ["holding"], "it is known to be set")
    planned.set(mode="driving")
    is_set(planned, 3.0)


def test_of_two_rules_that_set_a_parameter_the_first_wins(planned: Robot) -> None:
    planned.set(mode="slippery")
    until(lambda: planned.states("careful") == ["holding"], "it is set")
    planned.set(mode="icy")
    is_set(planned, 0.1)
    until(lambda: planned.states("careful") == ["waiting"], "the other waits")
    planned.set(mode="slippery")
    is_set(planned, 0.5)
    planned.set(mode="driving")
    is_set(planned, 3.0)
    values = planned.heard("/planner/double_")
    assert 3.0 not in values[values.index(0.5) : -1]


def test_a_parameter_of_another_type_is_not_set(planned: Robot) -> None:
    planned.set(mode="named")
    until(lambda: planned.states("name") == ["failed"], "a number cannot be a string")
    assert set(planned.heard("/planner/double_")) == {3.0}


def test_a_parameter_that_does_not_get_its_value_fails(planned: Robot) -> None:
    """The planner of ROS 1 takes 10 for 100, that of ROS 2 refuses."""
    planned.set(mode="exceeded")
    until(lambda: planned.states("exceed") == ["failed"], "10 is the most")
    until(lambda: planned.last("/planner/int_") == 0, "it is set back")


def test_a_parameter_that_is_set_too_late_is_set_back(planned: Robot) -> None:
    planned.set(delay=2.5, mode="slippery")
    until(lambda: planned.states("careful") == ["failed"], "its time is over")
    planned.set(delay=0.0)
    until(lambda: 0.5 in planned.heard("/planner/double_"), "it is set nevertheless")
    is_set(planned, 3.0)


def test_a_parameter_of_a_node_that_is_not_there_fails(driving: Robot) -> None:
    driving.set(mode="slippery")
    until(lambda: driving.states("careful") == ["failed"], "nobody answers")
    assert driving.states("cry") == ["done"]


# --- controllers ---------------------------------------------------------------------------------


def test_controllers_are_switched_and_back(controlled: Robot) -> None:
    controlled.set(mode="held")
    until(lambda: controlled.states("soften") == ["holding"], "they are switched")
    assert controlled.heard("/controllers") == [[["effort", "gravity"], ["position"]]]
    controlled.set(mode="driving")
    until(
        lambda: controlled.heard("/controllers")[1:] == [[["position"], ["effort", "gravity"]]],
        "they are switched back",
    )


def test_a_manager_that_refuses_is_a_failure(controlled: Robot) -> None:
    controlled.set(switches=False, mode="held")
    until(lambda: controlled.states("soften") == ["failed"], "it refuses")
    assert controlled.states("cry") == ["done"]
    controlled.set(mode="driving")
    until(lambda: controlled.states("soften") == [], "the rule is released")
    assert len(controlled.heard("/controllers")) == 1  # nothing is to be undone


def test_a_manager_that_is_not_there_is_a_failure(driving: Robot) -> None:
    driving.set(mode="held")
    until(lambda: driving.states("soften") == ["failed"], "nobody answers")
