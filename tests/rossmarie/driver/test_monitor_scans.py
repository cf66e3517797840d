"""Scans through the Python API: as messages, and as the numbers that rules read of them."""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

import pytest

from rossmarie import Monitor
from support.c_compiler import needs_c
from support.engines import ENGINES, load
from support.scans import LIES, plain_scan, truthful

pytestmark = needs_c

RULES = """\
action stop;
input scan = topic /scan : sensor_msgs/LaserScan up to 720 timeout 5 sec;
input back = topic /back : sensor_msgs/LaserScan .ranges timeout 5 sec;
rule near: if min(scan.ranges[-30 deg .. 30 deg]) < 0.5 m then { stop; };
rule beside: if any(p in scan.points: p.x < -0.2 m and p.y > 0.1 m) then { stop; };
rule blind: if count(b in scan.invalid: true) > 3 then { stop; };
rule limited: if scan.range_max < 10 m or scan.ranges[0] < 0.2 m then { stop; };
rule behind: if any(back[150 deg .. 210 deg] < 1 m) then { stop; };
"""
INF = math.inf


@pytest.fixture(params=ENGINES)
def monitor(request: pytest.FixtureRequest, tmp_path: Path) -> Monitor:
    return load(RULES, request.param, tmp_path)


def scan(**beams: float) -> SimpleNamespace:
    """A scan all around that sees little but at some degrees, `left_90` and the like."""
    ranges = [9.0, *[INF] * 359]  # of single elements infinity is unknown
    for name, reading in beams.items():
        side, degrees = name.split("_")
        ranges[180 + int(degrees) * (1 if side == "left" else -1)] = reading
    return plain_scan(ranges)


def send(monitor: Monitor, at_ns: int, value: object, back: object = None) -> set[str]:
    monitor.update(at_ns, {"scan": value, "back": back or scan()})  # type: ignore[dict-item]
    return set(monitor.active)


def test_scans_as_messages(monitor: Monitor) -> None:
    limited = scan()
    limited.range_max = 5.0
    for at_ns, sent, active in (
        (0, scan(), set()),
        (1, scan(left_10=0.4), {"near"}),
        (2, scan(left_135=1.0), {"beside"}),
        (3, scan(left_0=0.0), set()),
        (4, scan(left_0=0.0, left_1=0.0, left_2=0.0, right_9=math.nan), {"blind"}),
        (5, limited, {"limited"}),
        (6, scan(right_180=0.15), {"limited"}),
        (7, scan(), set()),
    ):
        assert send(monitor, at_ns, sent) == active
    assert send(monitor, 8, scan(), scan(right_180=0.5)) == {"behind"}


def test_numbers_instead_of_scans(monitor: Monitor) -> None:
    monitor.update(
        0,
        {
            "scan.ranges[-30 deg .. 30 deg]": [2.0, 0.4],
            "scan.points.range": [1.0],
            "scan.points.angle": [2.5],
            "scan.invalid": [{"angle": 0.0}],
            "scan.range_max": 12.0,
            "scan.ranges.0": 1.0,
            "back": [3.0],
        },
    )
    assert set(monitor.active) == {"near", "beside"}


def test_a_sector_of_an_input_of_ranges_goes_by_its_name(monitor: Monitor) -> None:
    monitor.update(0, {"scan": scan(), "back[150 deg .. 210 deg]": [3.0, 0.9]})
    assert set(monitor.active) == {"behind"}
    monitor.update(1, {"scan": scan(), "back[150 deg .. 210 deg]": [3.0, 1.1]})
    assert not monitor.active


@pytest.mark.parametrize("lie", LIES)
def test_of_a_scan_that_lies_nothing_is_known(monitor: Monitor, lie: str) -> None:
    sent = truthful()
    LIES[lie](sent)
    found = send(monitor, 0, sent)
    assert found >= {"near", "beside", "blind"}
