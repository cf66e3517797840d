"""Scans in tests: sectors that are set, and what generated tests set."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from rossmarie.driver.generating import generate_tests
from rossmarie.driver.pipeline import compile_file
from rossmarie.driver.testing import run_test_file
from rossmarie.testing.play import steps_of

RULES = """\
action stop;
input scan = topic /scan : sensor_msgs/LaserScan up to 360 timeout 1 sec;
rule near: if min(scan.ranges[-2 deg .. 2 deg]) < 0.5 m then { stop; };
rule dirty: if count(b in scan.invalid: true) > 3 then { stop; };
rule many: if count(p in scan.points: p.range < 10 m) > 300 then { stop; };
"""
INF = math.inf


def sent(folder: Path, *settings: str) -> list[dict[str, list[float]]]:
    """The numbers that are read of the scans that settings, one after the other, make."""
    statements = [f"at {second} s {each};" for second, each in enumerate(settings)]
    path = folder / "rules.ross"
    path.write_text(f'{RULES}test "a scan" {{ {" ".join(statements)} expect near active at 9 s; }}')
    compiled = compile_file(path)
    (script,) = compiled.tests
    names = ["sector", "invalid", "range"]
    found = [step.messages[0].arrays for step in steps_of(compiled.machine, script)]
    return [{names[index]: list(arrays[index]) for index in sorted(arrays)} for arrays in found]


def test_sectors_are_set(tmp_path: Path) -> None:
    found = sent(
        tmp_path,
        "scan",
        "scan.ranges[0 deg .. 1 deg] = 0.3 m",
        "scan.ranges[-2 deg .. 0 deg] = unknown",
        "scan.ranges[-2 deg .. 2 deg] = [1, 2] m",
        "scan.range_max = 1.5 m",
        "scan.ranges[-2 deg .. 2 deg] = [4] m",
        "scan.ranges[-2 deg .. 2 deg] = 0 m",
    )
    assert [each.get("sector") for each in found] == [
        [INF] * 5,
        [INF, INF, 0.3, 0.3, INF],
        [0.3, INF],
        [1.0, 2.0, INF, INF, INF],
        [1.0, INF, INF, INF, INF],
        [INF] * 5,
        None,
    ]
    assert [len(each["invalid"]) for each in found] == [0, 0, 3, 0, 0, 0, 5]
    assert [each["range"] for each in found[:4]] == [[], [0.3, 0.3], [0.3], [1.0, 2.0]]


@pytest.mark.parametrize(
    "lie", ["range_min = 40 m", "angle_increment = 2 deg", "ranges = [1, 2] m", "ranges = unknown"]
)
def test_of_a_scan_that_lies_nothing_is_known(tmp_path: Path, lie: str) -> None:
    assert sent(tmp_path, f"scan.{lie}") == [{}]


def test_generated_tests_set_sectors_and_pass(tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    path.write_text(RULES)
    written = generate_tests(path)
    assert "scan.ranges[-2 deg .. 2 deg] = " in written.text
    written.path.write_text(written.text)
    outcome = run_test_file(path)
    assert [one.title for ran in outcome.ran for one in ran.found] == []
    missing = set(outcome.coverage.goals) - outcome.coverage.reached
    assert not [goal for goal in missing if goal.rule == 0], "beams are not solved, sectors are"
