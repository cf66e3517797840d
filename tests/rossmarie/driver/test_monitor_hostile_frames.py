"""Scans that contradict themselves, transforms that are none, and a clock that jumps back: both
engines say the same of them, and nothing that was not measured clears a rule.
"""

from __future__ import annotations

import math
from pathlib import Path
from random import Random
from types import SimpleNamespace

import pytest

from rossmarie import Monitor
from support.c_compiler import needs_c
from support.engines import load

pytestmark = needs_c

RULES = """\
system robot {
    frame base in odom timeout 1 sec;
    frame laser in base at [1, 0, 0] m turned [0, 0, 180] deg;
}
action stop;
input scan = topic /scan : sensor_msgs/LaserScan up to 400 from laser in base timeout 5 sec;
input room = topic /scan : sensor_msgs/LaserScan .points up to 400 from laser in odom timeout 5 sec;
input raw = topic /scan : sensor_msgs/LaserScan up to 400 timeout 5 sec;
zone triangle in base { polygon [0, 0], [2, 0], [1, 2] m; }
zone hall in odom { box [-2, 2, -2, 2] m; }
rule inside: if any(p in scan.points: p in triangle) then { stop; };
rule near: if min(p in room: distance(p, hall)) < 0.5 m then { stop; };
rule behind: if min(raw.ranges[170 deg .. 190 deg]) < 0.5 m then { stop; };
rule blind: if count(b in raw.invalid: true) > 100 then { stop; };
"""
ODD = (0.0, -0.0, 1.0, -1.0, math.nan, math.inf, -math.inf, 1e308, -1e308, 5e-324, 3.14, 0.0174)
READINGS = (0.05, 0.2, 1.0, 3.0, math.nan, -math.inf, 0.0, -3.0, 13.0)
STEP = 2.0 * math.pi / 360.0


def odd_scan(random: Random) -> SimpleNamespace:
    """A scan all around, of which some numbers may be anything."""
    count = random.choice([360] * 9 + [0, 1, 2, 359, 361, 401, 1000])
    far, odd = (math.inf, 7.0), (*READINGS, math.inf)
    fields = {
        "angle_min": -math.pi,
        "angle_max": math.pi - STEP,
        "angle_increment": STEP,
        "range_min": 0.1,
        "range_max": 12.0,
    }
    for name in fields:
        if random.random() < 0.04:
            fields[name] = random.choice(ODD)
    if random.random() < 0.05:
        fields["angle_min"], fields["angle_max"] = fields["angle_max"], fields["angle_min"]
    ranges = [random.choice(odd if random.random() < 0.01 else far) for _ in range(count)]
    frame = random.choice(["laser"] * 9 + ["", "base"])
    header = SimpleNamespace(frame_id=frame)
    return SimpleNamespace(**fields, ranges=ranges, intensities=[], header=header)


def transform(random: Random) -> dict[str, float]:
    """The place of the base; now and then it is nonsense."""
    turn = dict(zip("xyzw", (0.0, 0.0, 0.0, 1.0), strict=True))
    place = {"x": random.uniform(-1.0, 1.0), "y": 0.0}
    if random.random() < 0.1:
        turn = {axis: random.choice(ODD) for axis in turn}
        place = {axis: random.choice(ODD) for axis in place}
    found = {f"base.translation.{axis}": value for axis, value in place.items()}
    return found | {f"base.rotation.{axis}": value for axis, value in turn.items()}


def reported(monitor: Monitor, seed: int) -> list[tuple[str, tuple[str, ...]]]:
    """The verdicts of a monitor on a random drive."""
    random, found = Random(seed), []
    for tick in range(250):
        at_ns = tick * 100_000_000 - (random.random() < 0.02) * 10**9
        values: dict[str, object] = {}
        if random.random() < 0.8:
            values |= dict.fromkeys(("scan", "room", "raw"), odd_scan(random))
        if random.random() < 0.7:
            values |= transform(random)
        events = monitor.update(at_ns, values) if values else monitor.advance(at_ns)  # type: ignore[arg-type]
        found.append((repr(events), tuple(monitor.active)))
    return found


@pytest.mark.parametrize("seed", range(6))
def test_both_engines_say_the_same(tmp_path: Path, seed: int) -> None:
    natively, plainly = (
        reported(load(RULES, kind, tmp_path), seed) for kind in ("native", "python")
    )
    assert natively == plainly
    seen = {rule for _, active in natively for rule in active}
    assert seen == {"inside", "near", "behind", "blind"}
    assert any(not active for _, active in natively)
