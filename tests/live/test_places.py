"""Places: a node knows whether the robot is in one, and how far away, in the frame of the scene."""

from __future__ import annotations

import time
from collections.abc import Callable

from support.live import Process, Robot, until

Start = Callable[..., Process]

INSIDE, BESIDE, OUTSIDE = (22.0, 1.0), (24.5, 1.0), (27.0, 1.0)


def test_a_robot_is_in_a_place_of_the_scene(robot: Robot, start: Start) -> None:
    start()

    def becomes(*rules: str, place: tuple[float, float], frame: str = "map") -> None:
        robot.set(mode="placed", place=[*place, frame])
        active = {"inside", "beside"} & set(robot.state().get("active", ()))
        until(
            lambda: {"inside", "beside"} & set(robot.state().get("active", ())) == set(rules),
            f"{place} in {frame}: {rules}, before {active}",
        )

    becomes("inside", "beside", place=INSIDE)
    becomes("beside", place=BESIDE)
    becomes(place=OUTSIDE)
    becomes("inside", "beside", place=INSIDE)
    # Nobody knows how a pose in another frame lies to the places: the rules stay as they are.
    robot.set(place=[*OUTSIDE, "odom"])
    time.sleep(1.0)
    becomes("inside", "beside", place=OUTSIDE, frame="odom")
    becomes(place=OUTSIDE)
