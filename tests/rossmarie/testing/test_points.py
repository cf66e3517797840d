"""Generated tests of conditions on points: in zones, near them, and seen from other frames."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.driver.generating import generate_tests
from rossmarie.driver.testing import run_test_file
from support.c_compiler import needs_c
from support.command_line import run as run_command

HEAD = """\
system robot {
    frame base_link in odom timeout 0.2 sec;
    frame laser in base_link at [0.2, 0, 0.1] m;
}
action stop;
input scan = topic /scan : sensor_msgs/LaserScan up to 720 from laser in base_link timeout 0.5 sec;
input hits = topic /hits : sensor_msgs/LaserScan .points up to 720 from base_link in odom
    timeout 0.5 sec;
input cloud = topic /points : sensor_msgs/PointCloud2 .points up to 9 from laser timeout 0.5 sec;
input place = topic /odom : nav_msgs/Odometry .pose.pose from odom timeout 0.5 sec;
zone ahead in base_link { box [0.3, 1.2, -0.4, 0.4] m; }
zone seen in laser { circle [1, 0] m radius 0.5 m; }
zone dock in odom { polygon [1, -1], [2, -1], [2, 1], [1, 1] m; }
"""


def left_to_see(folder: Path, condition: str) -> tuple[list[str], str]:
    """The goals of a rule that generated tests do not reach, and their text."""
    path = folder / "rules.ross"
    path.write_text(f"{HEAD}rule r: if {condition} then {{ stop; }};\n")
    written = generate_tests(path)
    written.path.write_text(written.text)
    tested = run_test_file(path, ())
    assert tested.ran
    assert not [finding for ran in tested.ran for finding in ran.found]
    missing = {*tested.coverage.goals} - tested.coverage.reached
    return sorted(goal.aspect.value for goal in missing), written.text


@needs_c
@pytest.mark.parametrize(
    "condition",
    [
        "any(p in scan.points: p in ahead)",
        "min(p in scan.points: distance(p, ahead)) < 0.5 m",
        "count(p in scan.points: p in ahead) >= 2",
        "any(p in hits: p in dock)",
        "count(p in cloud: p in seen) >= 3",
        "place in dock",
        "distance(place, dock) < 0.5 m",
    ],
)
def test_all_is_reached(tmp_path: Path, condition: str) -> None:
    missing, _ = left_to_see(tmp_path, condition)
    assert missing == []


def test_points_are_set_by_the_readings_beside_them(tmp_path: Path) -> None:
    _, text = left_to_see(tmp_path, "any(p in hits: p in dock)")
    assert "hits.ranges[-180 deg .. 180 deg] = 31 m" in text
    assert "hits.ranges[-0.5 deg .. 0.5 deg] = " in text


def test_what_is_left_out_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    zone = "zone far in base_link { box [20, 21, 20, 21] m; }"  # at 45 deg, where none is tried
    path.write_text(f"{HEAD}{zone}\nrule r: if any(p in scan.points: p in far) then {{ stop; }};\n")
    done = run_command("rossmarie", "test", path, "--write")
    assert (
        "r: no test makes `any(p in scan.points: p in far)` true: points were tried" in done.stdout
    )
    assert "set other beams by hand: `scan.ranges[A .. B] = ...`" in done.stdout
