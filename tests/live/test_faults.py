"""Each fault leaves commands on the robot's side within the limit, and a report names the cause."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable

import pytest

from support.live import SOME, Process, Robot, Ros, until

Start = Callable[..., Process]
Publish = Callable[..., Process]

LEVEL = "{orientation: {w: 1.0}}"
TILTED = "{orientation: {y: 0.1305, w: 0.9914}}"
"""15 degrees: at most 0.2 m/s."""


def test_a_publisher_is_killed(robot: Robot, start: Start, publish: Publish) -> None:
    robot.set(pitch=None)
    sensor = publish(50, "/imu/data", "sensor_msgs/Imu", LEVEL)
    start()
    robot.passes(1.0)
    sensor.end(signal.SIGKILL)
    robot.passes(0.0)
    robot.stays_at(0.0)
    why = robot.call("why")["text"]
    assert "cause: input orientation (/imu/data) is older than its timeout" in why


@pytest.mark.parametrize("topic", ["/imu/data", "imu/data"])
def test_stamps_are_frozen(robot: Robot, start: Start, topic: str) -> None:
    start(header_stamps=[topic])
    robot.passes(1.0)
    robot.set(frozen=True)
    robot.passes(0.0)
    robot.stays_at(0.0)
    robot.diagnosed("its stamp is")


def test_stamps_are_out_of_order(robot: Robot, start: Start) -> None:
    """A message older than the known state must not lift a limit."""
    robot.set(pitch=15.0, belated=0.0)
    start(header_stamps=["/imu/data"])
    robot.passes(0.2)
    robot.stays_at(0.2)
    robot.diagnosed("its stamp is not later than the previous stamp")


def test_an_input_is_not_a_number(robot: Robot, start: Start) -> None:
    start()
    robot.passes(1.0)
    robot.set(pitch="nan")
    robot.passes(0.0)
    robot.stays_at(0.0)
    cause = "messages arrive without a usable value: abs(orientation.pitch()) = unknown"
    assert cause in robot.call("why")["text"]
    robot.set(pitch=0.0)
    until(lambda: robot.call("reset", rule="")["success"], "it is safe")
    robot.passes(1.0)


def test_topics_are_flooded(robot: Robot, start: Start, publish: Publish) -> None:
    start()
    robot.passes(1.0)
    robot.set(pitch=15.0)
    robot.passes(0.2)
    robot.ask(forget="/cmd_vel")
    publish(1000, "/unfil_cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.9}}")
    publish(1000, "/imu/data", "sensor_msgs/Imu", TILTED)
    until(lambda: robot.count("/cmd_vel") > 1000, "the flood passes")
    assert set(robot.heard("/cmd_vel")) == {0.2}
    assert "abs(orientation.pitch()) > 10 deg" in robot.call("why")["text"]


def is_of_type(ros: Ros, found: str, wanted: str) -> str:
    return f"its type is {ros.ros_type(found)}, not {ros.ros_type(wanted)}"


def test_a_topic_is_of_another_type(ros: Ros, robot: Robot, start: Start, publish: Publish) -> None:
    robot.set(pitch=None)
    publish(20, "/imu/data", "std_msgs/Bool", "{data: true}")
    start()
    robot.passes(0.0)
    robot.diagnosed(is_of_type(ros, "std_msgs/Bool", "sensor_msgs/Imu"))
    robot.stays_at(0.0)


def test_commands_are_of_another_type(
    ros: Ros, robot: Robot, start: Start, publish: Publish
) -> None:
    robot.set(speed=None, pitch=15.0)
    publish(20, "/unfil_cmd_vel", "std_msgs/Bool", "{data: true}")
    start()
    robot.diagnosed(is_of_type(ros, "std_msgs/Bool", "geometry_msgs/Twist"))
    assert set(robot.commands(0.5)) <= {0.0}


def test_time_jumps_back(robot: Robot, start: Start) -> None:
    robot.set(clock=1000.0)
    start(use_sim_time=True)
    robot.passes(1.0)
    robot.hears_verdicts()
    robot.set(pitch=15.0)
    robot.passes(0.2)
    robot.ask(forget="/cmd_vel")
    robot.set(clock=500.0)
    reported = "/vehicle_safety/verdicts"
    until(lambda: any(v["change"] == 3 for v in robot.heard(reported)), "a verdict tells")
    until(lambda: robot.count("/cmd_vel") > SOME, "commands still pass")
    assert set(robot.heard("/cmd_vel")) == {0.2}
    robot.set(pitch=0.0)
    robot.passes(1.0)


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM], ids=str)
def test_the_node_is_reported_to_end(robot: Robot, start: Start, how: signal.Signals) -> None:
    node = start()
    robot.passes(1.0)
    node.end(how)
    until(lambda: robot.last("/cmd_vel") == 0.0, "the robot stands")
    robot.silent("/cmd_vel")


def test_the_node_is_killed(robot: Robot, start: Start) -> None:
    node = start()
    robot.passes(1.0)
    node.end(signal.SIGKILL)
    robot.silent("/cmd_vel")


@pytest.mark.usefixtures("launched")
def test_a_node_that_is_killed_comes_back_safe(ros: Ros, robot: Robot) -> None:
    robot.set(speed=None, pitch=15.0)
    robot.passes(0.2)
    robot.ask(forget="/cmd_vel")
    killed = ros.node_process()
    assert killed is not None
    os.kill(killed, signal.SIGKILL)
    until(lambda: ros.node_process() not in (killed, None), "the node is back")
    robot.passes(0.2)
    assert set(robot.heard("/cmd_vel")) <= {0.0, 0.2}


@pytest.mark.parametrize(
    ("parameters", "complaint"),
    [
        ({"filter_rate": 0.0}, "parameter filter_rate: the value must be between 0.1"),
        ({"filter_rate": float("nan")}, "parameter filter_rate: the value must be between 0.1"),
        ({"patience": "a while"}, "parameter patience: the value must be a number"),
        ({"state_file": 7}, "parameter state_file: the value must be a string"),
        (
            {"header_stamps": "/imu/data"},
            "parameter header_stamps: the value must be a list of strings",
        ),
        ({"header_stamps": ["/imu"]}, "parameter header_stamps: no rule reads /imu"),
        ({"heaviest": 31.0}, "parameter heaviest: the value must be between 0.03"),
        ({"heaviest": float("nan")}, "parameter heaviest: the value must be between 0.03"),
        ({"heaviest": "20 Nm"}, "parameter heaviest: the value must be a number"),
        ({"comand_timeout": 0.1}, "parameter comand_timeout: the node has no such parameter"),
    ],
    ids=str,
)
def test_a_parameter_is_wrong(
    robot: Robot, start: Start, parameters: dict[str, object], complaint: str
) -> None:
    node = start(**parameters)
    until(lambda: complaint in node.said(), complaint)
    assert robot.commands(0.2) == []
