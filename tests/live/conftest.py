"""The generations of ROS that live tests run on, and the robot in them."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import chain
from pathlib import Path
from typing import TypeAlias, cast

import pytest

from support import ros1_build, ros1_live, ros2_build, ros2_live, workspace
from support.live import LIMIT, Process, Robot, Ros, Wanted
from support.live_cases import vehicle as machine_of_vehicle
from support.parts import ROS1, ROS2, require

Needs: TypeAlias = Callable[[str], Sequence[Wanted]]
"""The packages to build for a test, in a generation of ROS."""

Built: TypeAlias = Mapping[Needs, Sequence[Path]]
"""Programs of nodes, and folders of those of packages."""


def pytest_configure(config: pytest.Config) -> None:
    """Build the packages of all tests at once, before the first test."""
    config.addinivalue_line("markers", "builds(by): what makes that of which `programs` are built")


@pytest.fixture(scope="session")
def sanitizing(pytestconfig: pytest.Config) -> Sequence[str]:
    """Arguments of cmake that build nodes with sanitizers, if this run wants that."""
    return workspace.SANITIZED if pytestconfig.getoption("--sanitize") else ()


@pytest.fixture(scope="session")
def ros1(
    tmp_path_factory: pytest.TempPathFactory, sanitizing: Sequence[str]
) -> Iterator[ros1_live.Ros1]:
    """ROS 1, with a running master. All workers of a run have one workspace."""
    require(ROS1)
    folder = of_all_workers(tmp_path_factory) / "ros1_workspace"
    built = ros1_build.Workspace(folder, (*ros1_build.QUICK, *sanitizing))
    found = ros1_live.Ros1(tmp_path_factory.mktemp("ros1"), built)
    try:
        yield found
    finally:
        found.end()


@pytest.fixture(scope="session")
def ros2(
    tmp_path_factory: pytest.TempPathFactory, sanitizing: Sequence[str]
) -> Iterator[ros2_live.Ros2]:
    """ROS 2. All workers of a run have one workspace."""
    require(ROS2)
    folder = of_all_workers(tmp_path_factory) / "ros2_workspace"
    built = ros2_build.Workspace(folder, (*ros2_build.QUICK, *sanitizing))
    found = ros2_live.Ros2(tmp_path_factory.mktemp("ros2"), built)
    try:
        yield found
    finally:
        found.end()


def of_all_workers(factory: pytest.TempPathFactory) -> Path:
    """A folder that the workers of a run share."""
    own = factory.getbasetemp()
    return own.parent if "PYTEST_XDIST_WORKER" in os.environ else own


@pytest.fixture(scope="module", params=["ros1", "ros2"])
def ros(request: pytest.FixtureRequest) -> Ros:
    """Each generation. The tests of a file stay together."""
    return cast("Ros", request.getfixturevalue(request.param))


@pytest.fixture(scope="session")
def built_on_ros1(request: pytest.FixtureRequest, ros1: ros1_live.Ros1) -> Built:
    """The packages of the tests in this run. Build them on first use, and try that only once."""
    return all_built(ros1, request.session.items)


@pytest.fixture(scope="session")
def built_on_ros2(request: pytest.FixtureRequest, ros2: ros2_live.Ros2) -> Built:
    """The packages of the tests in this run. Build them on first use, and try that only once."""
    return all_built(ros2, request.session.items)


@pytest.fixture
def built(request: pytest.FixtureRequest, ros: Ros) -> Built:
    """The built packages for the generation of the test."""
    return cast("Built", request.getfixturevalue(f"built_on_{ros.name}"))


def all_built(ros: Ros, tests: Iterable[pytest.Item]) -> Built:
    """Build the packages of several tests at once."""
    concerned = [test for test in tests if runs_on(test, ros.name)]
    needs = {mark.kwargs["by"] for test in concerned for mark in test.iter_markers("builds")}
    if any("vehicle" in names_of_fixtures(test) for test in concerned):
        needs.add(needs_of_vehicle)
    parts = {each: each(ros.name) for each in sorted(needs, key=lambda each: each.__module__)}
    programs = iter(ros.prepare(list(chain.from_iterable(parts.values()))))
    return {each: [next(programs) for _ in wanted] for each, wanted in parts.items()}


def runs_on(test: pytest.Item, generation: str) -> bool:
    """Say whether a test runs only on one generation of ROS."""
    parameters = test.callspec.params if hasattr(test, "callspec") else {}
    return parameters.get("ros") == generation or generation in names_of_fixtures(test)


def names_of_fixtures(test: pytest.Item) -> Sequence[str]:
    return test.fixturenames if isinstance(test, pytest.Function) else ()


def needs_of_vehicle(generation: str) -> Sequence[Wanted]:
    return [machine_of_vehicle(generation)]


@pytest.fixture
def programs(request: pytest.FixtureRequest, built: Built) -> Sequence[Path]:
    """The programs in the mark `builds` of the test."""
    mark = request.node.get_closest_marker("builds")
    return built[mark.kwargs["by"]]


@pytest.fixture
def vehicle(built: Built) -> Path:
    """The program of the node of the vehicle."""
    return built[needs_of_vehicle][0]


@pytest.fixture(autouse=True)
def forgotten(request: pytest.FixtureRequest) -> Iterator[None]:
    """After a test, who was killed in it is forgotten; no node of it had undefined behavior."""
    yield
    used = {id(each): each for each in request.node.funcargs.values()}
    for each in used.values():
        if isinstance(each, (ros1_live.Ros1, ros2_live.Ros2)):
            each.forget_all()
            assert not each.faults.new()


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
    """The processes that a test starts; they are ended after the test."""
    processes: list[Process] = []
    try:
        yield processes
    finally:
        for process in reversed(processes):
            process.end()


@pytest.fixture
def start(ros: Ros, started: list[Process], tmp_path: Path) -> Callable[..., Process]:
    """Starts the node, with parameters; each test has its own file of latched rules. The node waits
    for its inputs as long as the test does.
    """

    def start(*, use_sim_time: bool = False, **parameters: object) -> Process:
        usual = {"state_file": str(tmp_path / "latched"), "patience": LIMIT}
        started.append(ros.start({**usual, **parameters}, use_sim_time=use_sim_time))
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
    parameters = {"state_file": str(tmp_path / "latched"), "patience": LIMIT}
    launch = ros.launch(tmp_path, parameters)
    try:
        yield launch
    finally:
        launch.end_gently()
