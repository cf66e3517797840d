"""Clouds through the Python API: as messages, as dictionaries, and as columns."""

from __future__ import annotations

import math
from pathlib import Path
from random import Random
from types import SimpleNamespace

import numpy as np
import pytest

from rossmarie import Monitor
from rossmarie.native import ColumnError
from support.c_compiler import needs_c
from support.clouds import LIES, plain_cloud, random_cloud, truthful
from support.engines import ENGINES, load

pytestmark = needs_c

RULES = """\
action stop;
input cloud = topic /points : sensor_msgs/PointCloud2 .points up to 9 timeout 5 sec;
input bright = topic /points : sensor_msgs/PointCloud2 up to 9 timeout 5 sec;
rule near: if any(p in cloud: p.x < 0.8 m and p.z < 1 m) then { stop; };
rule blind: if count(p in cloud: true) < 2 then { stop; };
rule glaring: if max(p in bright.points: p.intensity) > 3 then { stop; };
"""
FAR = {"x": 5.0, "z": 5.0, "intensity": 0.0}
NEAR = {"x": 0.5, "z": 0.0, "intensity": 0.0}
NAN = math.nan
STALE = {"another name": ["near", "blind"], "a number twice": ["glaring"]}
"""The rules that do not know of the points, for lies about a field that only some read."""
FIELDS = ("x", "y", "z", "intensity")


@pytest.fixture(params=ENGINES)
def monitor(request: pytest.FixtureRequest, tmp_path: Path) -> Monitor:
    return load(RULES, request.param, tmp_path)


def cloud(*points: dict[str, float]) -> SimpleNamespace:
    return plain_cloud(points, FIELDS)


def send(monitor: Monitor, at_ns: int, value: object) -> list[str]:
    monitor.update(at_ns, {"cloud": value, "bright": value})  # type: ignore[dict-item]
    return list(monitor.active)


def test_clouds_as_messages_and_as_dictionaries(monitor: Monitor) -> None:
    for at_ns, points, active in (
        (0, [FAR, FAR], []),
        (1, [FAR, NEAR], ["near"]),
        (2, [FAR, FAR, {**NEAR, "x": NAN}], []),
        (3, [FAR, {**FAR, "z": NAN}], ["blind"]),
        (4, [FAR, {**FAR, "intensity": 4.0}], ["glaring"]),
        (5, [], ["blind"]),
    ):
        assert send(monitor, 2 * at_ns, cloud(*points)) == active
        assert send(monitor, 2 * at_ns + 1, points) == active


def test_a_place_that_no_rule_reads_is_one_all_the_same(monitor: Monitor) -> None:
    hidden = {**NEAR, "y": NAN}
    assert send(monitor, 0, cloud(FAR, FAR, hidden)) == []
    assert send(monitor, 1, [FAR, FAR, hidden]) == []


def test_clouds_as_columns(monitor: Monitor) -> None:
    columns = {"cloud.x": [0.5, NAN, 5.0], "cloud.z": [NAN, 0.0, 5.0], "bright": None}
    monitor.update(0, columns)
    assert list(monitor.active) == ["blind", "glaring"]
    monitor.update(1, {"cloud.x": [0.5, 5.0], "cloud.z": [0.0, 5.0], "bright": []})
    assert list(monitor.active) == ["near"]


@pytest.mark.parametrize("lie", [*LIES, "points without a field"])
def test_a_cloud_that_is_not_known_is_stale(monitor: Monitor, lie: str) -> None:
    assert send(monitor, 0, cloud(FAR, FAR)) == []
    value: object = [FAR, {"x": 5.0}]
    if lie in LIES:
        value = truthful()
        LIES[lie](value)
    assert send(monitor, 1, value) == STALE.get(lie, ["near", "blind", "glaring"])


def test_the_points_of_any_layout(monitor: Monitor) -> None:
    for seed in range(60):
        made = random_cloud(Random(seed))
        monitor.update(seed, {"cloud": made.cloud, "bright": made.cloud})
        assert list(monitor.active) == _active(
            made.expected(("x", "z")), made.expected(["intensity"])
        )


def _active(cloud: list[list[float]] | None, bright: list[list[float]] | None) -> list[str]:
    """The rules that are active, from the numbers that were put into a cloud."""
    found = {
        "near": cloud is None or any(x < 0.8 and z < 1.0 for x, z in zip(*cloud, strict=True)),
        "blind": cloud is None or len(cloud[0]) < 2,
        "glaring": bright is None
        or any(map(math.isnan, bright[0]))
        or max(bright[0], default=-math.inf) > 3.0,
    }
    return [name for name, is_active in found.items() if is_active]


def test_a_table_has_a_place_for_each_point(monitor: Monitor) -> None:
    times = np.array([1, 2])
    columns = {
        "cloud.x": np.array([[5.0, 0.5], [5.0, 5.0]]),
        "cloud.z": np.zeros((2, 2)),
        "bright.intensity": np.zeros((2, 0)),
    }
    assert monitor.run(times, columns).active.tolist() == [[True, False, False], [False] * 3]
    columns["cloud.z"] = np.array([[0.0, 0.0], [0.0, NAN]])
    with pytest.raises(ColumnError, match="a point without a position in row 1"):
        monitor.run(times, columns)
