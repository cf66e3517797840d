"""Scans: a node takes sectors, points and invalid beams, as the angles of a message say."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import SimpleNamespace

from support.live import Process, Robot, until
from support.scans import LIES, plain_scan

Start = Callable[..., Process]

RULES = {"ahead", "beside_it", "blind"}


def with_beams(beams: Mapping[int, float], first: int = -180, count: int = 360) -> SimpleNamespace:
    """A scan that sees nothing but at some degrees."""
    ranges = [math.inf] * count
    for degrees, reading in beams.items():
        ranges[(degrees - first) % 360] = reading
    return plain_scan(ranges, first)


def test_the_beams_of_scans_are_looked_at(robot: Robot, start: Start) -> None:
    start()

    def becomes(active: set[str], scan: SimpleNamespace, about: object) -> None:
        robot.set(laser=vars(scan))
        until(lambda: RULES & set(robot.state().get("active", ())) == active, f"{about}")

    def sends(beams: Mapping[int, float], *active: str, first: int = -180) -> None:
        becomes(set(active), with_beams(beams, first), beams)

    sends({0: 0.4}, "ahead")
    sends({0: 0.6})
    sends({30: 0.4}, "ahead")
    sends({31: 0.4})
    sends({-30: 0.4}, "ahead", first=0)  # that is, 330 deg
    sends({-31: 0.4}, first=0)
    sends({0: -math.inf}, "ahead")
    sends({0: 0.0})  # no return
    sends({135: 1.0}, "beside_it")  # at (-0.7, 0.7)
    sends({-135: 1.0})
    sends({135: 1.0, -5: 0.3}, "ahead", "beside_it")
    sends({135: 13.0})  # beyond range_max
    sends(dict.fromkeys(range(-10, 11), 0.0), "blind")
    sends(dict.fromkeys(range(-9, 11), 0.0))
    sends(dict.fromkeys(range(-10, 11), math.nan), "blind")
    # Of what lies nothing is known; the rules stay as they are until the next scan.
    sends({0: 0.4, 135: 1.0}, "ahead", "beside_it")
    for name, lie in LIES.items():
        scan = with_beams({})
        lie(scan)
        becomes({"ahead", "beside_it"}, scan, name)
    sends({})
