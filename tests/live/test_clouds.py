"""Clouds: a node takes the points out of the bytes of a message, as its fields say."""

from __future__ import annotations

import math
from collections.abc import Callable
from random import Random
from types import SimpleNamespace

from support.clouds import LIES, as_json, plain_cloud, random_cloud, truthful
from support.live import Process, Robot, until

Start = Callable[..., Process]

FIELDS = ("x", "y", "z", "intensity")
NEAR = {"x": 0.5, "z": -0.5, "intensity": 101.0}
FAR = {"x": 2.0, "intensity": 200.0}
DARK = {"x": 0.5, "intensity": 99.0}
LAYOUTS = 12


def test_the_points_of_clouds_are_looked_at(robot: Robot, start: Start) -> None:
    start()

    def becomes(is_active: bool, cloud: SimpleNamespace, about: object) -> None:
        robot.set(cloud=as_json(cloud))
        until(lambda: ("crowded" in robot.state().get("active", ())) == is_active, f"{about}")

    def sends(is_active: bool, *points: dict[str, float]) -> None:
        becomes(is_active, plain_cloud(points, FIELDS), points)

    sends(True, FAR, NEAR)
    sends(False, FAR, DARK)
    sends(True, NEAR)
    sends(False)
    sends(True, *[FAR] * 8, NEAR)
    sends(False, FAR, {**NEAR, "y": math.nan})
    for seed in range(LAYOUTS):  # each after a cloud that decides otherwise
        made = random_cloud(Random(seed))
        expected = made.expected(FIELDS)
        if expected is None:
            continue
        is_crowded = any(
            math.hypot(x, y, z) < 1.0 and intensity > 100.0
            for x, y, z, intensity in zip(*expected, strict=True)
        )
        sends(not is_crowded, *[FAR] * is_crowded, *[NEAR] * (not is_crowded))
        if not is_unknown(expected):
            becomes(is_crowded, made.cloud, f"seed {seed}")
    # Of what lies nothing is known; the rule stays as it is until the next cloud.
    sends(True, NEAR)
    for name, lie in LIES.items():
        cloud = truthful()
        lie(cloud)
        becomes(True, cloud, name)
    sends(False, FAR)


def is_unknown(columns: list[list[float]]) -> bool:
    """Say whether a number decides nothing: it is none, or the norm of what is infinite."""
    return not all(math.isfinite(number) for column in columns for number in column)
