"""Parameters of the rules: whoever starts a node can make a rule stricter."""

from __future__ import annotations

from collections.abc import Callable

from support.live import Process, Robot, until

Start = Callable[..., Process]


def test_s87_a_tighter_value_is_what_the_rule_goes_by(robot: Robot, start: Start) -> None:
    start(heaviest=20.0)

    def becomes(is_active: bool, effort: float) -> None:
        robot.set(efforts=[("elbow", effort)])
        until(lambda: ("heavy" in robot.state().get("active", ())) == is_active, f"{effort}")

    becomes(True, 21)
    becomes(False, 19)
    becomes(True, 31)


def test_s87_without_a_value_the_rule_goes_by_its_own(robot: Robot, start: Start) -> None:
    start()

    def becomes(is_active: bool, effort: float) -> None:
        robot.set(efforts=[("elbow", effort)])
        until(lambda: ("heavy" in robot.state().get("active", ())) == is_active, f"{effort}")

    becomes(True, 31)
    becomes(False, 21)
