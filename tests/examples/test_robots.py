"""Robots in the box: nothing is found, tests pass, recordings make each rule active and clear it.

`pytest --bless tests/examples/test_robots.py` writes recordings and generated tests.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.highlevel import AnyReader

from rossmarie.driver import check_file
from rossmarie.driver.build import build_files
from rossmarie.driver.formatting import format_text
from rossmarie.driver.replay import replay_file
from rossmarie.driver.robots import ROBOTS, BuiltInRobot, robots
from rossmarie.driver.testing import RanTests, run_test_file
from rossmarie.ir import Change, Verdict
from rossmarie.recordings.opening import open_recording
from rossmarie.testing.goals import Aspect
from support.generated import generated_tests
from support.simulated import simulated
from support.simulated.recording import write

MOST_LINES = 30
MOST_BYTES = 400_000
ROUNDING = 1 / 32
"""A step of the coarsest numbers: another C library may round a number the other way."""
MOST_DIFFERENT = 0.01
BEYOND_MC_DC = (Aspect.UNDER, Aspect.AT, Aspect.OVER, Aspect.STALE)
DECLARED = re.compile(r"^    topic (?:\w+ = )?(/\S+)\s+:\s+([\w/]+)", re.MULTILINE)

of_each_robot = pytest.mark.parametrize("robot", robots(), ids=lambda each: each.name)


def test_there_are_five() -> None:
    assert [each.name for each in robots()] == ["franka", "heron", "husky", "turtlebot4", "ur5e"]
    assert {each.name for each in ROBOTS.iterdir()} == {each.name for each in robots()}


# --- rules and tests -------------------------------------------------------------------------


@of_each_robot
def test_nothing_is_found(robot: BuiltInRobot) -> None:
    for path in robot.folder.glob("*.ross"):
        assert [one.title for one in check_file(path).diagnostics] == []


@of_each_robot
def test_rules_are_short_and_in_the_one_layout(robot: BuiltInRobot) -> None:
    text = robot.rules.read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line and not line.startswith("//")]
    assert len(lines) < MOST_LINES
    for path in (robot.rules, robot.folder / "system.ross"):
        assert format_text(path.read_text(encoding="utf-8")) == path.read_text(encoding="utf-8")


@of_each_robot
def test_the_generated_tests_are_those_beside_the_rules(robot: BuiltInRobot, bless: bool) -> None:
    written = generated_tests(robot.rules)
    beside = robot.rules.with_suffix(".tests.ross")
    if bless:
        beside.write_text(written, encoding="utf-8")
    assert beside.read_text(encoding="utf-8") == written


@of_each_robot
def test_they_pass_and_reach_all_of_mc_dc(robot: BuiltInRobot) -> None:
    found = outcome(robot)
    assert [one.title for ran in found.ran for one in ran.found] == []
    missing = set(found.coverage.goals) - found.coverage.reached
    assert [goal for goal in missing if goal.aspect not in BEYOND_MC_DC] == []


@cache
def outcome(robot: BuiltInRobot) -> RanTests:
    return run_test_file(robot.rules)


@of_each_robot
@pytest.mark.parametrize("target", ["ros1", "ros2"])
def test_a_node_comes_of_the_rules(robot: BuiltInRobot, target: str, tmp_path: Path) -> None:
    written = build_files(robot.rules, target, tmp_path).written
    assert tmp_path / "src" / "rules.cpp" in written


# --- recordings ------------------------------------------------------------------------------


@of_each_robot
def test_the_recording_is_what_the_simulation_says(robot: BuiltInRobot, bless: bool) -> None:
    store, reported = simulated(robot.name)
    expected = list(reported)
    if bless:
        write(robot.recording, store, expected)
    assert robot.recording.stat().st_size < MOST_BYTES
    different = 0
    for found, (*reported_where, kind, message) in zip(recorded(robot), expected, strict=True):
        *where, content = found
        assert where == [*reported_where, kind]
        if content != bytes(store.serialize_cdr(message, kind)):
            different += 1
            assert is_near(store.deserialize_cdr(content, kind), message), where
    assert different <= MOST_DIFFERENT * len(expected)


def recorded(robot: BuiltInRobot) -> Iterator[tuple[str, int, str, bytes]]:
    """The messages of a recording, as they are stored, in the order in which they stand there."""
    with AnyReader([robot.recording]) as reader:
        for connection, at_ns, content in reader.messages():
            yield connection.topic, at_ns, connection.msgtype, bytes(content)


def is_near(found: Any, wanted: Any) -> bool:
    """Say whether numbers of two messages differ by a step at most, and all else is the same."""
    if is_dataclass(found):
        names = [each.name for each in fields(found) if each.name != "__msgtype__"]
        return all(is_near(getattr(found, name), getattr(wanted, name)) for name in names)
    if isinstance(found, list):
        pairs = zip(found, wanted, strict=False)
        return len(found) == len(wanted) and all(is_near(*pair) for pair in pairs)
    if isinstance(found, str):
        return bool(found == wanted)
    return np.shape(found) == np.shape(wanted) and bool(np.allclose(found, wanted, 0.0, ROUNDING))


@of_each_robot
def test_topics_are_those_of_the_system_model(robot: BuiltInRobot) -> None:
    declared = dict(DECLARED.findall((robot.folder / "system.ross").read_text(encoding="utf-8")))
    with open_recording(robot.recording) as opened:
        reported = {topic.name: topic.message_type for topic in opened.topics.values()}
    transforms = {"/tf": "tf2_msgs/TFMessage", "/tf_static": "tf2_msgs/TFMessage"}
    assert reported.items() <= {**declared, **transforms}.items()


@of_each_robot
def test_the_recording_makes_each_rule_active_and_clears_it(robot: BuiltInRobot) -> None:
    replay, found = replay_file(robot.rules, robot.recording, topic_map={})
    assert [one.title for one in found] == []
    changes: dict[str, list[Change]] = {rule.name: [] for rule in replay.machine.rules}
    for event in replay.events:
        assert isinstance(event, Verdict)
        changes[replay.machine.rules[event.rule].name].append(event.change)
    both = (Change.ACTIVATED, Change.CLEARED)
    latched = {rule.name for rule in replay.machine.rules if rule.release is None}
    assert all(changes[name] == [Change.ACTIVATED] for name in latched)
    assert [
        name for name, seen in changes.items() if name not in latched and both not in pairwise(seen)
    ] == []


# --- what others say -------------------------------------------------------------------------


def test_heron_in_the_box_has_the_topics_of_heron() -> None:
    """Its own system model stands with its experiments; a topic of that name carries the same."""
    own = ROBOTS.parents[1] / "heron" / "rules" / "system.ross"
    declared = dict(DECLARED.findall(own.read_text(encoding="utf-8")))
    boxed = dict(DECLARED.findall((ROBOTS / "heron" / "system.ross").read_text(encoding="utf-8")))
    assert boxed.items() <= declared.items()
