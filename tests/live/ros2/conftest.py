"""These tests run on ROS 2 only."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from support.live import Process, Ros
from support.ros2_build import folder_of
from support.ros2_live import Ros2


@pytest.fixture(scope="module")
def ros(ros2: Ros2) -> Ros:
    """The one generation."""
    return ros2


@pytest.fixture
def container(
    ros2: Ros2, started: list[Process], tmp_path: Path, pytestconfig: pytest.Config
) -> str:
    """The name of a running container of components."""
    variables = dict(ros2.variables)
    if pytestconfig.getoption("--sanitize"):
        # The container was built without sanitizers.
        variables |= {"LD_PRELOAD": library("libasan.so"), "ASAN_OPTIONS": "detect_leaks=0"}
    program = folder_of("rclcpp_components") / "component_container_mt"
    started.append(Process([str(program)], variables, tmp_path / "container.log"))
    return "/ComponentManager"


def library(name: str) -> str:
    """The file of a library of gcc."""
    found = subprocess.run(["gcc", f"-print-file-name={name}"], stdout=subprocess.PIPE, text=True)
    return found.stdout.strip()
