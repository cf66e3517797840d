"""Tests whose phases take several messages."""

from __future__ import annotations

from pathlib import Path

from rossmarie.driver.generating import generate_tests
from rossmarie.driver.testing import run_test_file

RULES = """\
action slow;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
input ok = topic /ok : std_msgs/Bool timeout 1 sec;
rule seldom: if count(edges of speed < 0.5 m/s within 0.3 sec) < 1 then { slow; };
rule faulty: if not ok then { slow; };
"""


def test_edges_are_no_oscillation_of_the_number_that_is_read_last(tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    path.write_text(RULES)
    written = generate_tests(path)
    written.path.write_text(written.text)
    outcome = run_test_file(path)
    assert [one.title for ran in outcome.ran for one in ran.found] == []
