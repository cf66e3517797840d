"""The generations of ROS that live tests run on, and the robot in them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import cast

import pytest

from support import ros1_live, ros2_live
from support.live import Process, Robot, Ros
from support.parts import ROS1, ROS2, require


@pytest.fixture(scope="session")
def ros1(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ros1_live.Ros1]:
    """ROS 1, with a running master."""
    require(ROS1)
    found = ros1_live.Ros1(tmp_path_factory.mktemp("ros1"))
    try:
        yield found
    finally:
        found.end()


@pytest.fixture(scope="session")
def ros2(tmp_path_factory: pytest.TempPathFactory) -> ros2_live.Ros2:
    """ROS 2."""
    require(ROS2)
    return ros2_live.Ros2(tmp_path_factory.mktemp("ros2"))


@pytest.fixture(scope="session", params=["ros1", "ros2"])
def ros(request: pytest.FixtureRequest) -> Ros:
    """Each generation."""
    return cast("Ros", request.getfixturevalue(request.param))


@pytest.fixture(scope="session")
def vehicle(ros: Ros) -> Path:
    """The program of the node of the vehicle; if it cannot be built, it is tried once."""
    return ros.vehicle


@pytest.fixture(autouse=True)
def forgotten(request: pytest.FixtureRequest) -> Iterator[None]:
    """After a test that ran on ROS 1, who was killed in it is forgotten."""
    yield
    used = {id(each): each for each in request.node.funcargs.values()}
    for each in used.values():
        if isinstance(each, ros1_live.Ros1):
            each.forget_all()


@pytest.fixture
def robot(ros: Ros, vehicle: Path) -> Iterator[Robot]:
    """A robot that stands level, and a planner that wants 1 m/s."""
    assert vehicle.exists(), "the robot needs the messages of the node"
    found = ros.robot()
    try:
        found.set(pitch=0.0, speed=1.0)
        yield found
    finally:
        found.end()


@pytest.fixture
def started() -> Iterator[list[Process]]:
    """What a test starts; it is ended after the test."""
    processes: list[Process] = []
    try:
        yield processes
    finally:
        for process in reversed(processes):
            process.end()


@pytest.fixture
def start(ros: Ros, started: list[Process], tmp_path: Path) -> Callable[..., Process]:
    """Starts the node, with parameters; each test has its own file of latched rules."""

    def start(*, use_sim_time: bool = False, **parameters: object) -> Process:
        parameters = {"state_file": str(tmp_path / "latched"), **parameters}
        started.append(ros.start(parameters, use_sim_time=use_sim_time))
        return started[-1]

    return start


@pytest.fixture
def publish(ros: Ros, started: list[Process]) -> Callable[..., Process]:
    """Publishes a message at a rate, in a process of its own."""

    def publish(rate: int, topic: str, ros_type: str, message: str) -> Process:
        started.append(ros.publish(rate, topic, ros_type, message))
        return started[-1]

    return publish


@pytest.fixture
def launched(ros: Ros, tmp_path: Path) -> Iterator[Process]:
    """The launch file of the vehicle, with a planner that publishes /cmd_vel."""
    launch = ros.launch(tmp_path, {"state_file": str(tmp_path / "latched")})
    try:
        yield launch
    finally:
        launch.end_gently()
