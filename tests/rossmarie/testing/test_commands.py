"""Expectations of commands: what the safety filter lets through at an instant."""

from __future__ import annotations

from pathlib import Path

import pytest

from support.testing import INPUTS, run_text

LIMITS = """\
action limited {
    limit /cmd_vel : geometry_msgs/Twist { linear.x in [-0.2, 0.3] m/s; } ramp 0.3 m/s^2;
}
action held { scale /arm : geometry_msgs/Twist by 0 %; }
rule fast: if speed > 1 m/s then { limited; };
rule near: if min(ranges) < 1 m then { held; };
"""
MESSAGES = """\
    every 0.1 s from 0 s to 5 s orientation, speed, ranges, ok, state, fix;
    at 0 s speed = 0.5 m/s, ranges = [5] m;
    at 1 s speed = 2 m/s;
    at 2 s speed = 0.5 m/s;
    at 3 s ranges = [0.5] m;
"""


def failures(folder: Path, expectation: str, messages: str = MESSAGES) -> list[str]:
    text = f'{LIMITS}test "a" {{\n{messages}    expect {expectation};\n}}\n'
    (ran,) = run_text(folder, text).ran
    assert {finding.code for finding in ran.found} <= {"ROSS765"}
    return [f"{finding.title}: {finding.notes[0]}" for finding in ran.found]


@pytest.mark.parametrize(
    "expectation",
    [
        "/cmd_vel.linear.x in [-0.2, 0.3] m/s at 1 s",
        "/cmd_vel.linear.x in [-20, 30] cm/s from 1 s until 2 s",
        "/cmd_vel.linear.x in [-0.5, 0.6] m/s from 2 s to 3 s",  # the ramp lifts it by then
        "/arm.linear.y in [0, 0] m/s from 3 s to 5 s",
    ],
)
def test_what_is_limited_is_as_expected(tmp_path: Path, expectation: str) -> None:
    assert failures(tmp_path, expectation) == []


@pytest.mark.parametrize(
    ("expectation", "found"),
    [
        (
            "/cmd_vel.linear.x in [-0.2, 0.2] m/s from 0 s to 5 s",
            "`linear.x` of /cmd_vel may be anything at 0 s: no rule is active then",
        ),
        (
            "/cmd_vel.linear.x in [-0.2, 0.2] m/s from 1 s to 5 s",
            "`linear.x` of /cmd_vel may be [-0.2, 0.3] m/s at 1 s: active then: fast",
        ),
        (
            "/cmd_vel.linear.x in [-0.35, 0.45] m/s at 2.6 s",
            "`linear.x` of /cmd_vel may be [-0.38, 0.48] m/s at 2.6 s: "
            "no rule is active then; a limit is being lifted",
        ),
        (
            "/cmd_vel.angular.z in [-1, 1] rad/s at 1 s",
            "`angular.z` of /cmd_vel may be anything at 1 s: active then: fast",
        ),
    ],
)
def test_what_is_let_through_is_reported(tmp_path: Path, expectation: str, found: str) -> None:
    assert failures(tmp_path, expectation) == [found]


def test_a_topic_that_no_rule_limits(tmp_path: Path) -> None:
    rule = "action hold { block /lamp : geometry_msgs/Twist; }\n"
    rule += "rule r: if speed > 1 m/s then { slow; };\n"
    text = f'{rule}test "a" {{ at 0 s speed = 2 m/s; expect /lamp.linear.x in [0, 2] m/s at 0 s; }}'
    (ran,) = run_text(tmp_path, text).ran
    assert ran.found[0].notes == ("no rule starts an action that limits commands on /lamp",)


def test_nothing_passes_before_all_inputs_have_arrived(tmp_path: Path) -> None:
    only_speed = "    at 0.3 s speed = 0.5 m/s;\n"
    assert failures(tmp_path, "/cmd_vel.linear.x in [0, 0] m/s at 0.2 s", only_speed) == []
    all_of_them = INPUTS.count("timeout")
    assert all_of_them == 9
    assert failures(tmp_path, "/cmd_vel.linear.x in [0, 0] m/s at 0.2 s") != []
