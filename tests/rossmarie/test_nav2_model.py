"""The model of Nav2's collision monitor, against what its documentation and its sources say."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import pytest

from support.benchmarks import imported

MODULES = ("course_shapes", "course_scenes", "course", "nav2_settings", "nav2_model")


@pytest.fixture(scope="module")
def modules() -> Iterator[dict[str, Any]]:
    with imported(MODULES) as found:
        yield found


class Bench:
    """One query to the model: zones, readings by the degrees of their beams, a command."""

    def __init__(self, modules: dict[str, Any]) -> None:
        self._course, self._model = modules["course"], modules["nav2_model"]
        self._settings = modules["nav2_settings"]

    def zone(self, action: str, **others: Any) -> Any:
        corners = ((1.0, 0.5), (1.0, -0.5), (0.0, -0.5), (0.0, 0.5))
        return self._settings.Zone("zone", others.pop("points", corners), action, **others)

    def ask(
        self,
        zones: Sequence[Any],
        readings: dict[int, float],
        command: tuple[float, float] = (0.8, 0.0),
        age_s: float = 0.1,
    ) -> tuple[float, float]:
        ranges = np.full(360, math.inf, dtype=np.float32)
        for degrees, meters in readings.items():
            ranges[180 + degrees] = meters
        monitor = self._model.CollisionMonitor(self._settings.Settings("it", tuple(zones), 0.5))
        scan = self._course.Scan(0, ranges)
        wanted = self._course.Command(*command)
        given = monitor(scan, None, wanted, round(age_s * 1e9))
        return given.linear, given.angular


@pytest.fixture(scope="module")
def bench(modules: dict[str, Any]) -> Bench:
    return Bench(modules)


def beams(count: int, meters: float = 0.6, first: int = 0) -> dict[int, float]:
    return dict.fromkeys(range(first, first + count), meters)


def test_a_zone_counts_points(bench: Bench) -> None:
    stop = bench.zone("stop", min_points=4)
    assert bench.ask([stop], beams(3)) == (0.8, 0.0)
    assert bench.ask([stop], beams(4)) == (0.0, 0.0)
    assert bench.ask([stop], beams(4, meters=1.1)) == (0.8, 0.0)
    assert bench.ask([stop], beams(4, first=178 - 360)) == (0.8, 0.0), "behind the base"


def test_a_circle_lies_around_the_base(bench: Bench) -> None:
    circle = bench.zone("stop", points=(), radius=0.7)
    assert bench.ask([circle], beams(4, first=-140)) == (0.0, 0.0)
    assert bench.ask([circle], beams(4, meters=0.71)) == (0.8, 0.0)


@pytest.mark.parametrize("reading", [0.0, 0.1, math.inf, math.nan, 12.5, -math.inf])
def test_readings_out_of_range_are_no_points(bench: Bench, reading: float) -> None:
    around = bench.zone("stop", points=(), radius=100.0, min_points=1)
    assert bench.ask([around], {0: reading}) == (0.8, 0.0)
    assert bench.ask([around], {0: 11.9}) == (0.0, 0.0)


def test_an_old_scan_stops_the_base(bench: Bench) -> None:
    stop = bench.zone("stop")
    assert bench.ask([stop], {}, age_s=0.5) == (0.8, 0.0)
    assert bench.ask([stop], {}, age_s=0.51) == (0.0, 0.0)


def test_slowing_and_limits_keep_the_curve(bench: Bench) -> None:
    slow = bench.zone("slowdown", slowdown_ratio=0.25)
    assert bench.ask([slow], beams(4), (0.8, 0.4)) == (0.2, 0.1)
    limit = bench.zone("limit", linear_limit=0.4, angular_limit=0.1)
    assert bench.ask([limit], beams(4), (0.8, 0.1)) == (0.4, 0.05)
    assert bench.ask([limit], beams(4), (0.8, 0.4)) == pytest.approx((0.2, 0.1))
    assert bench.ask([limit], beams(4), (0.2, 0.0)) == (0.2, 0.0)


def test_the_slowest_zone_counts(bench: Bench) -> None:
    half = bench.zone("slowdown", slowdown_ratio=0.5)
    quarter = bench.zone("slowdown", slowdown_ratio=0.25)
    for zones in ([half, quarter], [quarter, half]):
        assert bench.ask(zones, beams(4)) == (0.2, 0.0)
    assert bench.ask([half, bench.zone("stop")], beams(4)) == (0.0, 0.0)


def test_approaching_keeps_the_time_before_a_collision(bench: Bench) -> None:
    outline = ((0.25, 0.2), (0.25, -0.2), (-0.25, -0.2), (-0.25, 0.2))
    numbers = {"min_points": 1, "time_before_collision": 2.0, "simulation_time_step": 0.1}
    approach = bench.zone("approach", points=outline, **numbers)
    # The front is at the point after 1.25 m, in the 16th step of 8 cm, which begins at 1.5 s.
    assert bench.ask([approach], {0: 1.5})[0] == pytest.approx(0.8 * 1.5 / 2.0)
    assert bench.ask([approach], {0: 2.5}) == (0.8, 0.0)
    assert bench.ask([approach], {0: 0.2}) == (0.0, 0.0), "already in it"
    assert bench.ask([approach], {0: 1.5}, (-0.8, 0.0)) == (-0.8, 0.0)
    assert bench.ask([approach], {20: 0.6}, (0.3, 0.0)) == (0.3, 0.0), "it passes by"
    assert bench.ask([approach], {20: 0.6}, (0.3, 0.6))[0] < 0.3, "it turns into it"
