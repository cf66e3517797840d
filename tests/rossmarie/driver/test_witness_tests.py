"""Witnesses of findings as tests that a user can keep, with the same behavior."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rossmarie.analysis.witness import Sending, Witness
from rossmarie.driver.analyze import Analysis, analyze_file
from rossmarie.driver.testing import RanTests, run_test_file
from rossmarie.driver.witness_tests import witness_tests
from rossmarie.ir import ChannelValues
from rossmarie.ir.script import Script
from rossmarie.testing.shown import is_shown, script_of
from support.depth import deep
from support.testing import compiled

INPUTS = """
input orientation = topic /imu/data : sensor_msgs/Imu .orientation timeout 0.2 sec
input turning = topic /imu/data : sensor_msgs/Imu .angular_velocity timeout 0.2 sec
input force = topic /wrench : geometry_msgs/Wrench .force timeout 0.1 sec
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec
input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 0.5 sec
input mode = topic /mode : std_msgs/String timeout 0.5 sec
input bumped = topic /bumped : std_msgs/Bool timeout 0.5 sec
input level = topic /level : std_msgs/UInt8 .data in % timeout 0.5 sec
input joy = topic /joy : sensor_msgs/Joy timeout 0.5 sec
input value = topic /value : rcl_interfaces/ParameterValue timeout 0.5 sec
input beat = topic /beat : std_msgs/Empty
action low { set /planner.speed to 0.2; }
action lower { set /planner.speed to 0.1; }
"""

PAIRS = {
    "angle": ("orientation.pitch() > 10 deg for 4 sec", "orientation.pitch() > 20 deg for 4 sec"),
    "angles": ("orientation.pitch() < -10 deg", "orientation.roll() > 170 deg"),
    "one topic": ("orientation.pitch() < -10 deg", "turning.z > 1 rad/s"),
    "length": ("norm(force) > 15 N", "force.y > 5 N"),
    "array": ("min(ranges) < 0.4 m", "any(ranges > 5 m) for 1 sec"),
    "count": ("count(ranges < 1 m) >= 2", "all(ranges < 4 m)"),
    "slope": ("rate(speed) < -1.5 m/s^2", "speed > 1 m/s"),
    "age": ("age(beat) > 1 sec", "age(beat) > 2 sec"),
    "text": ('mode == "driving" and speed > 1 m/s', 'mode != "docked"'),
    "another text": ('mode != "driving"', 'mode != "docked" and speed > 1 m/s'),
    "flag": ("bumped for 3 sec", "not bumped or speed > 2 m/s"),
    "flags": ("count(value.bool_array_value) > 1", "level > 7 %"),
    "buttons": ("joy.buttons[1] == 1", "joy.axes[0] > 0.5"),
    "missing": ("speed > 1 m/s", "speed < 0 m/s"),
    "swing": ("oscillates(turning.y, 4 times, within 2.0 sec, by 0.2 rad/s)", "bumped"),
}
TOGETHER = sorted((Path(__file__).parents[2] / "fixtures" / "together").glob("*.ross"))
LENGTHY = {"alternating", "decided", "holding", "latches", "limits", "over_time", "rates"}
"""Fixtures with so many findings that it takes seconds."""


def kept(analysis: Analysis, rules: Path) -> tuple[str, RanTests]:
    """The tests as they are written beside the rules, and what comes of them."""
    path = rules.parent / "found.ross"
    found = witness_tests(analysis, rules, path)
    assert found is not None
    assert found.left_out == ()
    assert found.count == sum(each.witness is not None for each in analysis.findings)
    path.write_text(found.text, encoding="utf-8")
    ran = run_test_file(path, in_c=False)
    assert [finding.title for each in ran.ran for finding in each.found] == []
    assert len(ran.ran) == found.count
    return found.text, ran


def ends_active(outcome: RanTests, script: Script) -> set[str]:
    """The rules that a test expects to be active at its end."""
    last_ns = max(expected.last_ns for expected in script.expectations)
    return {
        outcome.machine.rules[expected.rule].name
        for expected in script.expectations
        if expected.is_active and expected.last_ns == last_ns
    }


@pytest.mark.parametrize("pair", PAIRS)
def test_a_conflict_is_kept_as_a_test_in_which_both_rules_are_active(
    pair: str, tmp_path: Path
) -> None:
    one, two = PAIRS[pair]
    rules = tmp_path / "rules.ross"
    text = f"{INPUTS}rule one: if {one} then {{ low; }};\nrule two: if {two} then {{ lower; }};"
    rules.write_text(text, encoding="utf-8")
    _, outcome = kept(analyze_file(rules), rules)
    (conflict,) = (each.script for each in outcome.ran if each.script.name.startswith("ROSS700"))
    assert ends_active(outcome, conflict) == {"one", "two"}


@pytest.mark.parametrize(
    "fixture",
    [
        *(path for path in TOGETHER if path.stem not in LENGTHY),
        *deep(path for path in TOGETHER if path.stem in LENGTHY),
    ],
    ids=lambda path: path.stem,
)
def test_all_witnesses_of_all_queries_can_be_kept(fixture: Path, tmp_path: Path) -> None:
    rules = tmp_path / fixture.name
    rules.write_text(fixture.read_text(encoding="utf-8"), encoding="utf-8")
    kept(analyze_file(rules, thorough=True), rules)


def test_the_numbers_are_those_that_a_user_would_write(tmp_path: Path) -> None:
    rules = tmp_path / "rules.ross"
    pair = "\n".join(
        f"rule r{index}: if {condition} then {{ {action}; }};"
        for index, (condition, action) in enumerate(
            [("orientation.pitch() > 10 deg for 4 sec", "low"), ("speed > 5 km/h", "lower")]
        )
    )
    rules.write_text(INPUTS + pair, encoding="utf-8")
    text, _ = kept(analyze_file(rules), rules)
    assert "every 0.1 s from 0 s to 4 s orientation, speed;" in text
    reported = re.search(r"at 0 s orientation\.pitch = (\d+) deg, speed = (\d+) km/h;", text)
    assert reported is not None, text
    assert int(reported[1]) > 10
    assert int(reported[2]) > 5


def test_a_script_that_does_something_else_is_seen(tmp_path: Path) -> None:
    machine = compiled(tmp_path, "rule fast: if speed > 1 m/s then { slow; };").machine
    fast = Witness((Sending(0, {0: ChannelValues({0: 2.0}, {})}),), 100_000_000, is_calm=True)
    slow = Witness((Sending(0, {0: ChannelValues({0: 0.5}, {})}),), 100_000_000, is_calm=True)
    script = script_of(machine, fast, "a", (0,))
    assert script is not None
    assert is_shown(machine, fast, script, 0)
    assert not is_shown(machine, slow, script, 0)
