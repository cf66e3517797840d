"""The launch file: its arguments, and what it refuses."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from support.live import LIMIT, Process, Robot, Wanted, until
from support.ros2_live import Ros2

PROCESS = """\
from launch import LaunchDescription
from launch.actions import ExecuteProcess

PUBLISH = ["ros2", "topic", "pub", "--rate", "20", "/cmd_vel", "geometry_msgs/msg/Twist"]


def generate_launch_description():
    return LaunchDescription([ExecuteProcess(cmd=[*PUBLISH, "{linear: {x: 0.9}}"])])
"""
COMPONENTS = """\
from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer, LoadComposableNodes
from launch_ros.descriptions import ComposableNode

PLANNER = ComposableNode(package="ros2_planner", plugin="ros2_planner::Planner")


def generate_launch_description():
    if not LOADED:
        return LaunchDescription([ComposableNodeContainer(
            name="planning", namespace="", package="rclcpp_components",
            executable="component_container", composable_node_descriptions=[PLANNER])])
    return LaunchDescription([LoadComposableNodes(
        target_container="/ComponentManager", composable_node_descriptions=[PLANNER])])
"""
NOTHING = """\
from launch import LaunchDescription


def generate_launch_description():
    return LaunchDescription([])
"""
NODE = "/vehicle_safety"


def needs(generation: str) -> Sequence[Wanted]:
    """A planner that is a component."""
    return [Path(__file__).parents[2] / "support" / f"{generation}_planner"]


def settings(folder: Path) -> dict[str, object]:
    return {"state_file": str(folder / "latched"), "patience": LIMIT}


def test_a_process_that_cannot_be_renamed_is_refused(
    ros2: Ros2, robot: Robot, started: list[Process], tmp_path: Path
) -> None:
    robot.set(speed=None)
    started.append(ros2.launch_behind(PROCESS, tmp_path, settings(tmp_path)))
    launch = started[-1]
    until(lambda: launch.running.poll() is not None, "the launch file ends")
    assert launch.running.poll() != 0
    assert launch.running.stdout is not None
    said = launch.running.stdout.read()
    assert "cannot be put behind the filter of vehicle_safety" in said


def test_arguments_reach_the_node(
    ros2: Ros2, robot: Robot, started: list[Process], tmp_path: Path
) -> None:
    robot.set(clock=1000.0)
    arguments = {"use_sim_time": "true", "autostart": "false", "log_level": "warn"}
    launch = ros2.launch_behind(NOTHING, tmp_path, settings(tmp_path), **arguments)
    started.append(launch)
    until(lambda: "unconfigured" in ros2.command("lifecycle", "get", NODE), "it waits")
    assert "True" in ros2.command("param", "get", NODE, "use_sim_time")
    assert "successful" in ros2.command("lifecycle", "set", NODE, "configure")
    assert "successful" in ros2.command("lifecycle", "set", NODE, "activate")
    robot.passes(1.0)
    until(lambda: robot.state().get("at", 0.0) >= 1000.0, "its time is simulated")
    assert robot.state()["at"] < 1e6
    launch.end_gently()


def test_the_node_is_loaded_into_a_container(
    ros2: Ros2, robot: Robot, started: list[Process], container: str, tmp_path: Path
) -> None:
    launch = ros2.launch_behind(NOTHING, tmp_path, settings(tmp_path), container=container)
    started.append(launch)
    robot.passes(1.0)
    robot.set(pitch=15.0)
    robot.passes(0.2)
    launch.end_gently()


@pytest.mark.builds(by=needs)
@pytest.mark.usefixtures("programs")
@pytest.mark.parametrize("is_running", [False, True])
def test_a_planner_in_a_container_is_behind_the_filter(
    ros2: Ros2,
    robot: Robot,
    started: list[Process],
    container: str,
    tmp_path: Path,
    is_running: bool,
) -> None:
    """The launch file starts the container, or loads the planner into a running container."""
    robot.set(speed=None)
    planner = COMPONENTS.replace("LOADED", repr(is_running)).replace("/ComponentManager", container)
    launch = ros2.launch_behind(planner, tmp_path, settings(tmp_path))
    started.append(launch)
    robot.passes(0.7)
    robot.set(pitch=15.0)
    robot.passes(0.2)
    robot.stays_at(0.2)
    launch.end_gently()


def test_a_node_of_another_name_logs_under_it(
    ros2: Ros2, robot: Robot, started: list[Process], tmp_path: Path
) -> None:
    """The console says why the robot slows down."""
    parameters = ["-p", f"state_file:={tmp_path / 'latched'}", "-r", "__node:=guard"]
    command = [str(ros2.vehicle), "--ros-args", *parameters]
    started.append(Process(command, ros2.variables, tmp_path / "guard.log"))
    robot.passes(1.0)
    robot.set(pitch=15.0)
    reported = "[guard]: rule tilted is active: abs(orientation.pitch()) = 15 deg"
    until(lambda: reported in started[-1].said(), "it is told that a rule is active")
