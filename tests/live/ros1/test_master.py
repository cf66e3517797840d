"""A master that is started anew knows nobody."""

from __future__ import annotations

from pathlib import Path

from support.live import Process, Robot, until
from support.ros1_live import Ros1, master_of


def test_the_master_is_started_anew(
    ros1: Ros1, robot: Robot, launched: Process, started: list[Process], tmp_path: Path
) -> None:
    """The node ends, because nobody new could find it, and comes back as it was."""
    robot.set(pitch=15.0)
    robot.passes(0.2)
    before = ros1.node_process()
    with ros1.without_master():
        robot.stays_at(0.2)
    until(lambda: ros1.node_process() not in (before, None), "the node is back")
    assert "the ROS master was restarted" in launched.said()
    with master_of(ros1.variables) as master:
        state_file = master.getParam("/test", "/vehicle_safety/state_file")[2]
    assert state_file == str(tmp_path / "latched")
    started.append(anew := ros1.robot())
    anew.set(pitch=15.0, speed=1.0)
    anew.passes(0.2)


def test_who_was_killed_is_known_until_all_are_forgotten(ros1: Ros1) -> None:
    robot = ros1.robot()
    try:
        until(lambda: "/robot" in publishers(ros1), "the robot publishes")
    finally:
        robot.end()
    assert "/robot" in publishers(ros1)
    ros1.forget_all()
    assert publishers(ros1) == set()


def publishers(ros1: Ros1) -> set[str]:
    """The nodes that the master tells others to listen to."""
    with master_of(ros1.variables) as master:
        topics, _, _ = master.getSystemState("/test")[2]
    return {node for _, nodes in topics for node in nodes}
