"""Tests are written of the rules of a user, and not of those of the library that these import."""

from __future__ import annotations

from pathlib import Path

from rossmarie.driver.generating import generate_tests
from rossmarie.driver.workspace import LIBRARY

RULES = """\
import "rossmarie/base/tilt.ross" as tilt;
import "rossmarie/deros.ross";
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.2 sec;
rule fast: if speed > 1 m/s then { stop; };
"""


def test_rules_of_the_library_get_no_tests_of_a_user(tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    path.write_text(RULES, encoding="utf-8")
    text = generate_tests(path).text
    assert 'test "fast: ' in text
    assert "tilt." not in text


def test_a_file_of_the_library_gets_its_own() -> None:
    assert 'test "openWhenHard: ' in generate_tests(LIBRARY / "gripper" / "grip.ross").text
