"""How a node starts, and what it says of a world that is not as expected."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from support.ros1_live import Process, Robot, set_parameters, until

Start = Callable[..., Process]


def diagnoses(robot: Robot) -> dict[str, str]:
    """The last diagnostics that were told: their messages, by name."""
    told = robot.heard("/diagnostics")
    return {status["name"]: status["message"] for status in told[-1]["status"]} if told else {}


def test_nothing_passes_before_all_inputs_have_come(robot: Robot, start: Start) -> None:
    robot.set(pitch=None)
    start(patience=1000.0)
    until(lambda: robot.commands(0.1)[-1:] == [0.0], "the node sends 0")
    assert set(robot.commands(0.5)) == {0.0}
    assert "nothing has come on /imu/data" in robot.call("why")["text"]
    assert robot.state()["active"] == []
    robot.set(pitch=0.0)
    until(lambda: robot.commands(0.1)[-1:] == [1.0], "commands pass")


def test_an_input_that_does_not_come_counts_as_lost(robot: Robot, start: Start) -> None:
    robot.set(pitch=None)
    start(patience=0.5)
    until(lambda: (robot.state() or {}).get("active") == ["tilted", "fallen"], "rules are active")
    assert "has never been received" in robot.call("why")["text"]


def test_a_grace_period_lets_commands_pass_as_the_rules_say(robot: Robot, start: Start) -> None:
    robot.set(pitch=None)
    start(patience=0.2, grace_period=1.0)
    until(lambda: bool((robot.state() or {}).get("open")), "the filter opens")
    until(lambda: "grace period" in diagnoses(robot).get("vehicle_safety: node", ""), "it is told")
    assert set(robot.commands(0.3)) == {0.0}  # the rules that lack the input still hold


def test_a_topic_that_nobody_publishes_is_named(robot: Robot, start: Start) -> None:
    start()
    name = "vehicle_safety: topic /scan"
    until(lambda: diagnoses(robot).get(name) == "nobody publishes it", "it is named")


def test_time_that_jumps_back_is_told(robot: Robot, start: Start) -> None:
    robot.set(clock=1000.0)
    start(use_sim_time=True)
    until(lambda: robot.commands(0.1)[-1:] == [1.0], "commands pass")
    robot.set(clock=500.0)
    verdicts = "/vehicle_safety/verdicts"
    until(lambda: any(v["change"] == 3 for v in robot.heard(verdicts)), "a verdict tells")
    until(lambda: robot.commands(0.1)[-1:] == [1.0], "commands still pass")
    robot.set(pitch=15.0)
    until(lambda: robot.commands(0.1)[-1:] == [0.2], "rules still hold")


@pytest.fixture
def launched(variables: dict[str, str], program: Path, tmp_path: Path) -> Iterator[None]:
    """The package's launch file, with a planner that publishes /cmd_vel."""
    planner = tmp_path / "planner.launch"
    planner.write_text(
        '<launch><node pkg="rostopic" type="rostopic" name="planner" '
        "args=\"pub -r 20 /cmd_vel geometry_msgs/Twist '{linear: {x: 0.7}}'\"/></launch>",
        encoding="utf-8",
    )
    set_parameters(variables, {}, use_sim_time=False)
    command = ["/usr/bin/roslaunch", "vehicle_safety", "vehicle_safety.launch"]
    log = Path(variables["HOME"]) / "launch.log"
    process = Process([*command, f"commands:={planner}"], variables, log)
    try:
        yield
    finally:
        process.end_gently()


@pytest.mark.usefixtures("launched")
def test_the_launch_file_puts_the_planner_behind_the_filter(robot: Robot) -> None:
    robot.set(speed=None)
    until(lambda: robot.commands(0.2)[-1:] == [0.7], "0.7 m/s passes", 20)
    robot.set(pitch=15.0)
    until(lambda: robot.commands(0.2)[-1:] == [0.2], "at most 0.2 m/s passes")
    time.sleep(0.2)
    assert set(robot.commands(0.5)) == {0.2}


def test_a_node_with_an_impossible_parameter_does_not_start(robot: Robot, start: Start) -> None:
    node = start(filter_rate=0.0)
    assert node.running.wait(10) == 1
