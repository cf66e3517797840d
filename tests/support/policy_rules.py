"""Rules over a base that are small, and a guard of a policy by them."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.driver import compile_file
from rossmarie.guard import Declared, Guard

RULES = """
system robot {
    topic /cmd_vel : geometry_msgs/Twist;
    node planner { publishes /cmd_vel; }
}
input speed = topic /speed : std_msgs/Float64 in m/s timeout 1 sec;
input scan = topic /scan : sensor_msgs/LaserScan timeout 1 sec;
input held = topic /held : std_msgs/Bool timeout 1 sec;
action slow { limit /cmd_vel { linear.x in [-0.2, 0.2] m/s; } ramp 0.1 m/s^2; }
action back { publish /cmd_vel { linear.x = -0.1 m/s; } at 10 Hz; }
action nudge { publish /cmd_vel { angular.z = 0.5 rad/s; }; }
action tell { log warning "it is fast"; }
action stop { block /cmd_vel; } latched until reset;
rule fast: if speed > 1 m/s then { slow; tell; } feedback 2 per activation, 30 per min,
    margin in km/h;
rule near: if any(scan.ranges < 0.5 m) then { back; } feedback 4 per sec, margin in mm;
rule far: if any(scan.ranges > 5 m) then { nudge; };
rule held_up: if held then { stop; };
"""
OBSERVE: Declared = {"speed": 0, "held": 1, "scan": slice(2, 4)}
ACT: Declared = {"linear.x": 0, "angular.z": 1}


def guard_of(
    kind: str,
    folder: Path,
    *,
    rules: str = RULES,
    observe: Declared = OBSERVE,
    act: Declared = ACT,
) -> Guard:
    """A guard of this kind: `native` or `python`."""
    path = folder / "rules.ross"
    path.write_text(rules, encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        if kind == "python":
            patch.setenv("CC", "no-such-compiler")
        machine = compile_file(path).with_margins
        guard = Guard(machine, observe, act)
    assert guard.kind == kind
    return guard
