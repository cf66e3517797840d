"""The start of a node, and its reports about an unexpected environment."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from support.live import Process, Robot, Ros, until
from support.parts import GCC, X86, needs

Start = Callable[..., Process]
FLUSHING = """\
#include <xmmintrin.h>
__attribute__((constructor)) static void flush(void) { _mm_setcsr(_mm_getcsr() | 0x8040); }
"""
"""Libraries that gcc links with -ffast-math do so, whoever loads them."""
SOON = 10.0
"""Seconds, of the node; it looks every two, and a busy machine lets it wait."""
STATUS = {"ros1": "/status", "ros2": "/_action/status"}


def test_nothing_passes_before_all_inputs_have_come(robot: Robot, start: Start) -> None:
    robot.set(pitch=None)
    start(patience=1000.0)
    robot.stays_at(0.0)
    assert "no message has arrived on /imu/data" in robot.call("why")["text"]
    until(lambda: robot.state().get("active") == [], "no rule is active")
    robot.set(pitch=0.0)
    robot.passes(1.0)


def test_an_input_that_does_not_come_counts_as_stale(robot: Robot, start: Start) -> None:
    robot.set(pitch=None)
    start(patience=0.5)
    until(lambda: robot.state().get("active") == ["tilted", "fallen"], "rules are active")
    assert "has never been received" in robot.call("why")["text"]


def test_a_grace_period_lets_commands_pass_as_the_rules_say(robot: Robot, start: Start) -> None:
    robot.set(pitch=None)
    start(patience=0.2, grace_period=1.0)
    until(lambda: bool(robot.state().get("open")), "the filter opens")
    until(
        lambda: "grace period" in robot.diagnoses().get("vehicle_safety: node", ""),
        "it is reported",
    )
    robot.stays_at(0.0)  # the rules that lack the input still hold


def test_a_topic_that_nobody_publishes_is_named(robot: Robot, start: Start) -> None:
    start()
    name = "vehicle_safety: topic /scan"
    until(lambda: robot.diagnoses().get(name) == "no node publishes it", "it is named")


def test_servers_that_are_not_there_are_named(ros: Ros, robot: Robot, start: Start) -> None:
    start()
    gripper = "vehicle_safety: action server /gripper"
    planner = "vehicle_safety: parameter /planner.double_"
    manager = "vehicle_safety: controller manager /controller_manager"
    missing = {
        gripper: f"no node publishes /gripper{STATUS[ros.name]}",
        planner: "no node offers /planner/set_parameters",
        manager: "no node offers /controller_manager/switch_controller",
    }
    until(lambda: missing.items() <= robot.diagnoses().items(), "they are named")
    reported = robot.heard("/diagnostics")
    named = next(each for each in reported if gripper in {one["name"] for one in each["status"]})
    assert named["header"]["stamp"] - reported[0]["header"]["stamp"] < SOON
    assert "vehicle_safety: action server /arm" not in robot.diagnoses()
    assert "vehicle_safety: service /lamp" not in robot.diagnoses()
    robot.ask(offer="planner")
    robot.ask(offer="controllers")
    until(lambda: planner not in robot.diagnoses(), "it has come")
    until(lambda: manager not in robot.diagnoses(), "it has come")
    assert gripper in robot.diagnoses()


def test_a_controller_that_is_not_there_is_named(robot: Robot, start: Start) -> None:
    robot.set(controllers=["effort", "position"])
    robot.ask(offer="controllers")
    start()
    robot.diagnosed("/controller_manager has no controller gravity")
    reported = robot.heard("/diagnostics")
    named = next(each for each in reported if "no controller" in str(each["status"]))
    assert named["header"]["stamp"] - reported[0]["header"]["stamp"] < SOON
    robot.set(mode="held")
    until(lambda: robot.states("soften") == ["failed"], "it is not switched")
    robot.set(mode="driving", controllers=["effort", "gravity", "position"])
    until(lambda: "no controller" not in str(robot.diagnoses()), "it has come")


@pytest.mark.usefixtures("launched")
def test_the_launch_file_puts_the_planner_behind_the_filter(robot: Robot) -> None:
    robot.set(speed=None)
    robot.passes(0.7)
    robot.set(pitch=15.0)
    robot.passes(0.2)
    robot.stays_at(0.2)


@needs(GCC)
@needs(X86)
def test_a_node_that_computes_wrongly_does_not_begin(
    ros: Ros, robot: Robot, start: Start, tmp_path: Path
) -> None:
    (tmp_path / "flushing.c").write_text(FLUSHING, encoding="utf-8")
    library = tmp_path / "flushing.so"
    command = ["gcc", "-shared", "-fPIC", "flushing.c", "-o", str(library)]
    subprocess.run(command, cwd=tmp_path, check=True)
    # Of nodes that were built with sanitizers, these would insist on being loaded first.
    added = {"LD_PRELOAD": str(library), "ASAN_OPTIONS": "verify_asan_link_order=0"}
    ros.variables.update(added)
    try:
        node = start()
    finally:
        for name in added:
            del ros.variables[name]
    until(
        lambda: "computes wrong results: subnormal numbers count as 0" in node.said(), "it says why"
    )
    assert robot.commands(1.0) == []
