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
    # Of names and torques of other numbers nobody knows which belong together.
    robot.set(efforts=[("elbow", 31), ("wrist", None)])
    robot.set(torques=[0, 31, 0])
    until(lambda: "driven" in robot.state().get("active", ()), "what was sent later has arrived")
    assert "heavy" not in robot.state()["active"]


def test_s55_a_joint_is_found_by_its_declared_name_where_the_length_fits(
    robot: Robot, start: Start
) -> None:
    start()

    def is_driven() -> bool:
        return "driven" in robot.state().get("active", ())

    def becomes(is_active: bool, torques: list[object]) -> None:
        robot.set(torques=torques)
        until(lambda: is_driven() == is_active, f"{torques}")

    def stays(is_active: bool, torques: list[object], effort: int) -> None:
        """Joints in an array of another length are unknown. Messages that are sent later have
        arrived before this test looks.
        """
        robot.set(torques=torques)
        robot.set(efforts=[("elbow", effort)])
        until(lambda: ("heavy" in robot.state().get("active", ())) == (effort > 30), f"{effort}")
        assert is_driven() == is_active, torques

    becomes(True, [90, 31, 90])
    stays(True, [3, 3, 3, 3], 31)
    stays(True, [3, 3], 3)
    stays(True, [], 31)
    becomes(False, [90, 29, "nan"])
    stays(False, [90, 90, 90, 90], 3)
    stays(False, [90, 90], 31)
    becomes(True, [0, 31, 0])
