"""The lifecycle manager of Nav2 brings the node up, and notices that it has died."""

from __future__ import annotations

import signal
from collections.abc import Callable
from pathlib import Path

import pytest

from support.live import Process, Robot, until
from support.parts import NAV2, needs
from support.ros2_live import Ros2

pytestmark = needs(NAV2)


@pytest.fixture
def manager(ros2: Ros2, started: list[Process], tmp_path: Path) -> Callable[[], Process]:
    """Starts a lifecycle manager that is responsible for the node."""

    def begin() -> Process:
        command = ["ros2", "run", "nav2_lifecycle_manager", "lifecycle_manager", "--ros-args"]
        settings = ["-p", "autostart:=true", "-p", "node_names:=[vehicle_safety]"]
        log = tmp_path / "manager.log"
        started.append(Process([*command, *settings], ros2.variables, log))
        return started[-1]

    return begin


def test_it_activates_the_node(
    robot: Robot, start: Callable[..., Process], manager: Callable[[], Process]
) -> None:
    start(autostart=False)
    managing = manager()
    robot.passes(1.0)
    until(lambda: "connected with bond" in managing.said(), "there is a bond")


def test_it_notices_that_the_node_has_died(
    robot: Robot, start: Callable[..., Process], manager: Callable[[], Process]
) -> None:
    node = start(autostart=False)
    managing = manager()
    until(lambda: "nodes are active" in managing.said(), "the manager has done its work")
    robot.commands(2.0)  # bondcpp misses a death before the second heartbeat, one in 0.1 s
    node.end(signal.SIGKILL)
    until(lambda: "vehicle_safety IS DOWN" in managing.said(), "it says so")
    assert robot.commands(0.5) == []
