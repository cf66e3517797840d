"""The master, the workspace and the robot of the live tests."""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from rossmarie.driver.build import generate
from support import ros1_live as live
from support.c_compiler import write
from support.ros1_cases import vehicle


@pytest.fixture(scope="session")
def variables(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, str]]:
    """The environment of a running master."""
    if lacking := live.missing():
        pytest.skip(lacking)
    folder, port = tmp_path_factory.mktemp("ros1"), live.free_port()
    found = live.environment(folder, port)
    master = live.Process(
        ["/usr/bin/rosmaster", "--core", "-p", str(port)], found, folder / "master.log"
    )
    try:
        live.until(lambda: live.is_up(port), "the master is up", 30)
        yield found
    finally:
        master.end()


@pytest.fixture(scope="session")
def program(variables: dict[str, str]) -> Path:
    """The node, built by catkin_make from a generated package, without a warning."""
    workspace = Path(variables["HOME"]) / "workspace"
    write(generate(vehicle(), "ros1"), workspace / "src" / "vehicle_safety")
    command = ["catkin_make", "-j2", f"-DPYTHON_EXECUTABLE={live.PYTHON}"]
    done = subprocess.run(command, cwd=workspace, env=variables, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "warning:" not in done.stderr, done.stderr
    return workspace / "devel" / "lib" / "vehicle_safety" / "vehicle_safety"


@pytest.fixture
def robot(variables: dict[str, str], program: Path) -> Iterator[live.Robot]:
    """A robot that stands level, and a planner that wants 1 m/s."""
    found = live.Robot(variables, Path(variables["HOME"]) / "robot.log")
    try:
        found.set(pitch=0.0, speed=1.0)
        yield found
    finally:
        found.end()


@pytest.fixture
def start(
    variables: dict[str, str], program: Path, tmp_path: Path
) -> Iterator[Callable[..., live.Process]]:
    """Starts the node, with parameters; each test has its own file of latched rules."""
    started: list[live.Process] = []

    def start(*, use_sim_time: bool = False, **parameters: object) -> live.Process:
        parameters = {"state_file": str(tmp_path / "latched"), **parameters}
        live.set_parameters(variables, parameters, use_sim_time=use_sim_time)
        started.append(
            live.Process([str(program)], variables, Path(variables["HOME"]) / "node.log")
        )
        return started[-1]

    try:
        yield start
    finally:
        for node in started:
            node.end()
