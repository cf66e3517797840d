"""Joints by name: drivers order them as they like, and a rule looks at the one that it names."""

from __future__ import annotations

from collections.abc import Callable

from support.live import Process, Robot, until

Start = Callable[..., Process]


def test_a_joint_is_found_wherever_it_stands(robot: Robot, start: Start) -> None:
    start()

    def becomes(is_active: bool, efforts: list[tuple[str, object]]) -> None:
        robot.set(efforts=efforts)
        until(lambda: ("heavy" in robot.state().get("active", ())) == is_active, f"{efforts}")

    becomes(True, [("shoulder", 90), ("elbow", 31)])
    becomes(False, [("elbow", 29), ("shoulder", 90)])
    becomes(True, [("elbow", 31), ("shoulder", "nan")])
    # Of a joint that is missing, or there twice, nothing is known; the next message clears it.
    becomes(False, [("elbow", 3)])
    becomes(True, [("wrist", 3), ("elbow", 31)])
    becomes(False, [("wrist", 90), ("elbow", 3)])
