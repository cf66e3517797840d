"""Fixes leave the program right."""

from __future__ import annotations

import pytest

from dslkit.diagnostics import Severity, apply_edits
from support.programs import check_text

HEAD = """
action stop;
const limit = 20 deg
input imu = topic /imu : sensor_msgs/Imu timeout 1 sec
"""


def fixed(text: str) -> str:
    """The text with the first fix applied."""
    _, found = check_text(text)
    fix = next(finding.fix for finding in found if finding.fix is not None)
    return apply_edits(text, fix.edits)


def test_a_number_used_as_range_and_as_number_keeps_its_declaration() -> None:
    text = fixed(
        HEAD
        + "if imu.orientation.pitch() not in limit or imu.orientation.roll() > limit"
        + " then { stop; };"
    )
    assert "const limit = 20 deg" in text
    assert "not in [-20, 20] deg or" in text
    assert check_text(text)[1] == ()


def test_an_ambiguous_for_gets_the_parentheses_that_it_has_by_precedence() -> None:
    text = fixed(
        HEAD
        + "if imu.orientation.pitch() > limit and imu.orientation.roll() > limit for 2 sec"
        + " then { stop; };"
    )
    assert "limit and (imu.orientation.roll() > limit for 2 sec) then" in text
    assert check_text(text)[1] == ()


def fixed_condition(condition: str) -> str:
    """The condition of a rule with its first fix applied; it is right then."""
    inputs = """
        input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 1 sec
        input ok = topic /ok : std_msgs/Bool timeout 1 sec
        input mode = topic /mode : std_msgs/String timeout 1 sec
        input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 1 sec
    """
    text = fixed(f"{inputs} action go; rule it: if {condition} then {{ go; }};")
    errors = [one.title for one in check_text(text)[1] if one.severity is Severity.ERROR]
    assert errors == []
    return text.split("rule it: if ")[1].split(" then")[0]


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("any(ranges < 1 m for 1 sec)", "any(ranges < 1 m) for 1 sec"),
        ("ok and all(ranges < 1 m for 1 sec)", "ok and (all(ranges < 1 m) for 1 sec)"),
        ("(any(ranges < 1 m for 1 sec))", "(any(ranges < 1 m) for 1 sec)"),
        ("any(ranges < 1 m or ok)", "any(ranges < 1 m) or ok"),
        ("not any(ok or ranges < 1 m)", "not (ok or any(ranges < 1 m))"),
        ('mode in ["a", "b"]', 'mode == "a" or mode == "b"'),
        ('ok and mode not in ["a"]', 'ok and (mode != "a")'),
        ("speed in [-0.5, 0.5]", "speed in [-0.5, 0.5] m/s"),
        ("speed > 10 km / h", "speed > 10 km/h"),
        ("rate(speed) > 1 m / s / s", "rate(speed) > 1 m/s/s"),
        ("rate(ranges[0]) / 1 m > 1 /s", "rate(ranges[0]) / 1 m > 1 Hz"),
        ("rate(ranges[0]) / 1 m > 6 / min", "rate(ranges[0]) / 1 m > 6 / 1 min"),
    ],
)
def test_what_is_written_instead_means_the_same_wherever_it_stands(
    written: str, meant: str
) -> None:
    assert fixed_condition(written) == meant


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("in // say what arrives in\n  V timeout", "// say what arrives in\n   timeout"),
        ("// in volt\n in V timeout", "// in volt\n timeout"),
        ("in V timeout", " timeout"),
    ],
)
def test_leaving_out_a_unit_keeps_the_comments_before_it(written: str, meant: str) -> None:
    head = "action go;\ninput w = topic /t : geometry_msgs/Twist .linear"
    text = fixed(f"{head} {written} 1 sec\nif w.x > 1 m/s then {{ go; }};\n")
    assert meant in text
    assert " V " not in text
    assert check_text(text)[1] == ()


def test_leaving_out_a_field_keeps_the_comments_before_it() -> None:
    head = "action go;\ninput level = topic /t : std_msgs/Float32 in V timeout 1 sec\n"
    text = fixed(head + "if level // its data. in V.\n .data > 1 V then { go; };\n")
    assert "if level // its data. in V.\n" in text
    assert check_text(text)[1] == ()


COMMANDED = """
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 1 sec;
action slow { limit /cmd_vel : geometry_msgs/Twist { linear.x in [-0.2, 0.2] m/s; }; }
rule fast: if speed > 1 m/s then { slow; };
"""


@pytest.mark.parametrize("misspelt", ["/cmd_ve", "cmd_val"])
def test_a_misspelt_topic_of_a_test_becomes_the_one_that_an_action_commands(misspelt: str) -> None:
    expected = f"expect {misspelt}.linear.x in [0, 1] m/s at 0 s;"
    text = fixed(f'{COMMANDED}test "t" {{ at 0 s speed = 2 m/s; {expected} }}')
    assert "cmd_vel.linear.x in [0, 1]" in text
    assert check_text(text)[1] == ()


def test_a_topic_that_is_like_none_is_reported_which_ones_are_commanded() -> None:
    text = COMMANDED + 'test "t" { expect /arm_joints.x in [0, 1] at 0 s; }'
    (finding,) = check_text(text)[1]
    assert finding.notes == ("actions command `/cmd_vel`",)
    assert finding.fix is None
