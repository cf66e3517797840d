"""Robots in the box: a generated node says of the recording of a robot what a replay says of it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from rosbags import rosbag1
from rosbags.typesys import Stores

from rossmarie.driver import compile_file
from rossmarie.driver.robots import BuiltInRobot, robots
from support.live import Ros, Wanted
from support.live_replay import Changes, replayed, says
from support.message_packages import write_packages
from support.simulated import simulated
from support.simulated.recording import store_of, write_bag

NEAR = {"ros1": 0.03, "ros2": 0.2}
"""Seconds by which instants may differ: in ROS 2, what is played comes late on a busy machine."""
BEGIN_S = 3.5
"""A node waits for all its inputs; a replay sees one after the other. By then all are there."""
CLEARED = 0


@cache
def _kept() -> TemporaryDirectory[str]:
    """Packages stay until they are built."""
    return TemporaryDirectory()


def needs(_generation: str) -> Sequence[Wanted]:
    """A node for each robot, and its messages."""
    folder = Path(_kept().name)
    machines = [compile_file(each.rules).machine for each in robots()]
    packages = [one for each in robots() for one in write_packages(each.folder / "msg", folder)]
    return [*machines, *packages]


pytestmark = [pytest.mark.builds(by=needs)]


@pytest.mark.parametrize("index", range(len(robots())), ids=[each.name for each in robots()])
def test_a_node_says_what_a_replay_says(
    ros: Ros, programs: Sequence[Path], index: int, tmp_path: Path
) -> None:
    robot = robots()[index]
    wanted = replayed(robot.rules, robot.recording, NEAR[ros.name], (BEGIN_S, math.inf))
    activated = {rule for rule, change, _ in wanted if change != CLEARED}
    assert activated == {rule.name for rule in compile_file(robot.rules).machine.rules}
    played = {"ros1": of_ros1, "ros2": of_ros2}[ros.name](robot, tmp_path / "drive")
    reported = says(
        ros, programs[index], tmp_path / "latched", lambda: ros.play(played), len(wanted)
    )
    assert of_each_rule(reported) == of_each_rule(wanted)


def of_ros2(robot: BuiltInRobot, folder: Path) -> Path:
    """The topics of the robot that the rules read."""
    topics = {channel.topic for channel in compile_file(robot.rules).machine.channels}
    store, reported = simulated(robot.name)
    write_bag(folder, store, (each for each in reported if each[0] in topics))
    return folder


def of_ros1(robot: BuiltInRobot, path: Path) -> Path:
    """The same as a bag of ROS 1."""
    topics = {channel.topic for channel in compile_file(robot.rules).machine.channels}
    ros2, reported = simulated(robot.name)
    ros1 = store_of(robot, Stores.ROS1_NOETIC)
    path = path.with_suffix(".bag")
    with rosbag1.Writer(path) as writer:
        connections: dict[str, Any] = {}
        for topic, at_ns, kind, message in reported:
            if topic in topics:
                if topic not in connections:
                    connections[topic] = writer.add_connection(topic, kind, typestore=ros1)
                content = ros2.cdr_to_ros1(ros2.serialize_cdr(message, kind), kind)
                writer.write(connections[topic], at_ns, content)
    return path


def of_each_rule(changes: Changes) -> dict[str, list[tuple[int, Any]]]:
    """The changes of each rule with their times. Rules that change at the same instant may come in
    any order.
    """
    found: dict[str, list[tuple[int, Any]]] = {}
    for rule, change, at in changes:
        found.setdefault(rule, []).append((change, at))
    return found
