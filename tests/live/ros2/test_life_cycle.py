"""While the node is not active no command passes, whoever decides that."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from support.live import Process, Robot, until
from support.ros2_live import Ros2

Start = Callable[..., Process]

NODE = "/vehicle_safety"


def test_a_node_without_autostart_waits(ros2: Ros2, robot: Robot, start: Start) -> None:
    start(autostart=False)
    until(lambda: "unconfigured" in ros2.command("lifecycle", "get", NODE), "it is there")
    assert robot.commands(0.5) == []
    assert "successful" in ros2.command("lifecycle", "set", NODE, "configure")
    assert robot.commands(0.5) == []
    assert "successful" in ros2.command("lifecycle", "set", NODE, "activate")
    robot.passes(1.0)


def test_a_node_that_is_deactivated_stops_the_robot(ros2: Ros2, robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    assert "successful" in ros2.command("lifecycle", "set", NODE, "deactivate")
    assert robot.last("/cmd_vel") == 0.0
    assert robot.commands(0.5) == []
    assert "successful" in ros2.command("lifecycle", "set", NODE, "activate")
    robot.passes(1.0)


def test_goals_do_not_go_on_without_the_node(ros2: Ros2, robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    robot.ask(goal=7)
    until(lambda: robot.heard("/arm") == [["begins", 7]], "the arm begins")
    assert "successful" in ros2.command("lifecycle", "set", NODE, "deactivate")
    until(lambda: robot.last("/arm") == ["is cancelled", 7], "it is cancelled")


def test_a_node_that_cannot_keep_its_latched_rules_stays_active(
    ros2: Ros2, robot: Robot, start: Start, tmp_path: Path
) -> None:
    folder = tmp_path / "folder"
    folder.mkdir()
    node = start(state_file=str(folder / "latched"))
    robot.passes(1.0)
    shutil.rmtree(folder)
    robot.set(pitch=40.0)
    robot.passes(0.0)
    assert "failed" in ros2.command("lifecycle", "set", NODE, "deactivate").lower()
    assert "it cannot save the latched rules" in node.said()
    robot.stays_at(0.0)


def test_parameters_are_fixed_while_it_runs(ros2: Ros2, robot: Robot, start: Start) -> None:
    start(patience=5)
    robot.passes(1.0)
    assert "clean up the node first" in ros2.command("param", "set", NODE, "patience", "100.0")


def test_parameters_can_be_set_after_a_cleanup(ros2: Ros2, robot: Robot, start: Start) -> None:
    start(patience="a while")
    until(lambda: "unconfigured" in ros2.command("lifecycle", "get", NODE), "it says why")
    assert "Set parameter successful" in ros2.command("param", "set", NODE, "patience", "50.0")
    assert "successful" in ros2.command("lifecycle", "set", NODE, "configure")
    assert "clean up the node first" in ros2.command("param", "set", NODE, "patience", "60.0")
    assert "successful" in ros2.command("lifecycle", "set", NODE, "cleanup")
    assert "Set parameter successful" in ros2.command("param", "set", NODE, "patience", "60.0")
    assert "successful" in ros2.command("lifecycle", "set", NODE, "configure")
    assert "successful" in ros2.command("lifecycle", "set", NODE, "activate")
    robot.passes(1.0)


def test_parameters_have_defaults_and_descriptions(ros2: Ros2, robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    assert "0.5" in ros2.command("param", "get", NODE, "command_timeout")
    reported = ros2.command("param", "describe", NODE, "filter_rate")
    assert "The rate (Hz) at which the node" in reported
    assert "1000.0" in reported


@pytest.mark.parametrize(
    ("parameters", "complaint"),
    [
        ({"qos_overrides./imu/dat.subscription.reliability": "reliable"}, "one of /imu/data"),
        (
            {"qos_overrides./imu/data.subscription.relibility": "reliable"},
            "the only QoS parameter is",
        ),
        ({"qos_overrides./imu/data.subscription.depth": 5}, "the only QoS parameter is"),
        ({"qos_overrides./imu/data.subscription.reliability": "sure"}, "reliable or best_effort"),
        ({"qos_overrides./imu/data.subscription.reliability": 1}, "reliable or best_effort"),
        ({"autostart": 1}, "parameter autostart: the value must be true or false"),
        ({"header_stamps": ["/imu"]}, "parameter header_stamps: no rule reads /imu"),
        ({"header_stamps": ["/mode"]}, "parameter header_stamps: messages on /mode have no header"),
    ],
    ids=str,
)
def test_a_node_with_a_wrong_parameter_stays_unconfigured(
    ros2: Ros2, robot: Robot, start: Start, parameters: dict[str, object], complaint: str
) -> None:
    """Messages come meanwhile, and the process does not end."""
    node = start(**parameters)
    until(lambda: complaint in node.said(), complaint)
    until(lambda: "unconfigured" in ros2.command("lifecycle", "get", NODE), "it is there")
    assert robot.commands(1.0) == []
    assert node.running.poll() is None


def test_a_node_whose_activation_fails_takes_no_messages(
    ros2: Ros2, robot: Robot, start: Start, tmp_path: Path
) -> None:
    """A file that cannot be written keeps it from being active; then a manager tries again."""
    node = start(state_file=str(tmp_path / "no folder" / "latched"), autostart=False)
    until(lambda: "unconfigured" in ros2.command("lifecycle", "get", NODE), "it is there")
    assert "successful" in ros2.command("lifecycle", "set", NODE, "configure")
    for _ in range(3):
        assert "failed" in ros2.command("lifecycle", "set", NODE, "activate").lower()
    assert "cannot write" in node.said()
    assert robot.commands(1.0) == []
    (tmp_path / "no folder").mkdir()
    assert "successful" in ros2.command("lifecycle", "set", NODE, "activate")
    robot.passes(1.0)


def test_the_node_is_a_component(ros2: Ros2, robot: Robot, container: str, tmp_path: Path) -> None:
    load = ["component", "load", container, "vehicle_safety", "vehicle_safety::SafetyNode"]
    settings = ["-p", f"state_file:={tmp_path / 'latched'}"]
    until(lambda: "Loaded component" in ros2.command(*load, *settings), "it is loaded")
    robot.passes(1.0)
    robot.set(pitch=15.0)
    robot.passes(0.2)
    robot.set(pitch=40.0)
    until((tmp_path / "latched").exists, "it has the parameters that it was loaded with")
