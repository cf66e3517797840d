"""Rules with tests as text, compiled in memory's stead in a folder, and run."""

from __future__ import annotations

from pathlib import Path

from rossmarie.driver.pipeline import Compiled, compile_file
from rossmarie.driver.testing import RanTests, run_tests

INPUTS = """\
action slow;
action stop;
input orientation = topic /imu/data : sensor_msgs/Imu .orientation timeout 0.2 sec;
input acceleration = topic /imu/data : sensor_msgs/Imu .linear_acceleration timeout 0.2 sec;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 0.5 sec;
input path = topic /plan : nav_msgs/Path .poses up to 8 timeout 1 sec;
input cloud = topic /points : sensor_msgs/PointCloud2 .points up to 8 timeout 1 sec;
input fix = topic /fix : sensor_msgs/NavSatFix timeout 30 sec;
input state = topic /state : std_msgs/String timeout 1 sec;
input ok = topic /ok : std_msgs/Bool timeout 1 sec;
"""


def compiled(folder: Path, text: str) -> Compiled:
    """Rules on the inputs above."""
    path = folder / "rules.ross"
    path.write_text(INPUTS + text, encoding="utf-8")
    return compile_file(path)


def run_text(folder: Path, text: str) -> RanTests:
    """All tests of such rules, run."""
    found = compiled(folder, text)
    return run_tests(found, found.tests)


def notes(found: RanTests) -> list[tuple[str, str]]:
    """The title and the note of each failure."""
    return [(finding.title, "; ".join(finding.notes)) for ran in found.ran for finding in ran.found]
