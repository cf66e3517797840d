"""Two robots on one machine, each with its node in its namespace."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from support.clouds import as_json, plain_cloud
from support.live import LIMIT, Process, Robot, Ros, until

NAMESPACES = ("/robot1", "/robot2")
Pair = tuple[Robot, Robot]


@pytest.fixture
def robots(ros: Ros, vehicle: Path) -> Iterator[Pair]:
    """Both stand level, without planners."""
    assert vehicle.exists(), "the robots need the messages of the node"
    found = [ros.robot(namespace) for namespace in NAMESPACES]
    try:
        for robot in found:
            robot.set(pitch=0.0, speed=None)
        yield found[0], found[1]
    finally:
        for robot in found:
            robot.end()


@pytest.fixture
def begin(ros: Ros, started: list[Process], tmp_path: Path) -> Callable[..., Process]:
    """Starts the node of a robot, with parameters."""

    def begin(namespace: str, **parameters: object) -> Process:
        started.append(ros.start({"patience": LIMIT, **parameters}, namespace=namespace))
        return started[-1]

    return begin


def test_a_planner_is_behind_the_filter_of_its_own_robot(
    ros: Ros, robots: Pair, tmp_path: Path
) -> None:
    """Its launch file knows nothing of namespaces, and wants 0.7 m/s."""
    launches = []
    try:
        for namespace, robot in zip(NAMESPACES, robots, strict=True):
            folder = tmp_path / namespace[1:]
            folder.mkdir()
            parameters = {"state_file": str(folder / "latched"), "patience": LIMIT}
            launches.append(ros.launch(folder, parameters, namespace))
            robot.passes(0.7)
        robots[1].set(pitch=40.0)
        robots[1].passes(0.0)
        robots[1].stays_at(0.0)
        robots[0].stays_at(0.7)
        robots[0].set(pitch=15.0)
        robots[0].passes(0.2)
        until(lambda: "robot2/vehicle_safety: node" in robots[0].diagnoses(), "each has its name")
        assert robots[0].state()["active"] == ["tilted"]
        assert robots[1].state()["active"] == ["tilted", "fallen"]
    finally:
        for launch in launches:
            launch.end_gently()


def test_a_reset_of_one_robot_leaves_the_latched_rules_of_the_other(
    robots: Pair, begin: Callable[..., Process]
) -> None:
    """Their files are those that nodes have where nothing is said."""
    nodes = [begin(namespace) for namespace in NAMESPACES]
    for robot in robots:
        robot.set(speed=1.0)
        robot.passes(1.0)
        robot.set(pitch=40.0)
        robot.passes(0.0)
        robot.set(pitch=0.0)
    until(lambda: robots[1].call("reset", rule="")["success"], "it is safe")
    robots[1].passes(1.0)
    nodes[0].end()
    robots[0].ask(forget="/vehicle_safety/state")
    begin(NAMESPACES[0])
    until(lambda: robots[0].state().get("open", False), "the node has all inputs")
    robots[0].stays_at(0.0)
    assert "latched before the node started" in robots[0].call("why")["text"]
    assert robots[0].call("reset", rule="")["success"]
    robots[0].passes(1.0)


def test_two_nodes_do_not_share_a_file_of_latched_rules(
    robots: Pair, begin: Callable[..., Process], tmp_path: Path
) -> None:
    shared = str(tmp_path / "latched")
    for robot in robots:
        robot.set(speed=1.0)
    begin(NAMESPACES[0], state_file=shared)
    robots[0].passes(1.0)
    second = begin(NAMESPACES[1], state_file=shared)
    until(lambda: "is used by another node" in second.said(), "it says why it does not start")
    assert set(robots[1].commands(0.5)) <= {0.0}
    robots[0].stays_at(1.0)


def test_lists_and_clouds_of_one_robot_are_not_those_of_the_other(
    robots: Pair, begin: Callable[..., Process]
) -> None:
    one, other = robots
    for namespace in NAMESPACES:
        begin(namespace)

    def active(robot: Robot) -> set[str]:
        return {"crowded", "failing"} & set(robot.state().get("active", ()))

    def sees(robot: Robot, x: float) -> None:
        point = {"x": x, "intensity": 101.0}
        robot.set(cloud=as_json(plain_cloud([point], ("x", "y", "z", "intensity"))))

    sees(one, 0.5)
    other.set(parts=[("motor", "ERROR")])
    until(lambda: (active(one), active(other)) == ({"crowded"}, {"failing"}), "each has its own")
    sees(other, 0.5)
    sees(one, 5.0)
    until(lambda: (active(one), active(other)) == (set(), {"crowded", "failing"}), "they change")
