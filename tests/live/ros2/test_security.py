"""The policy for SROS2: it has what the node uses. Under access control nobody else commands."""

from __future__ import annotations

import json
import subprocess
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import pytest

from rossmarie.targets.ros2 import security
from support.live import Process, Robot, until
from support.live_cases import vehicle as machine_of_vehicle
from support.parts import SROS2, needs
from support.ros2_live import Ros2

NODE = "vehicle_safety"
ENCLAVES = (f"/{NODE}", f"/behind_{NODE}")

PLANNER = """\
from launch import LaunchDescription
from launch_ros.actions import Node

SCRIPT = '''{script}'''


def generate_launch_description():
    arguments = ["--enclave", "/behind_vehicle_safety"]
    return LaunchDescription([
        Node(executable="python3", arguments=["-c", SCRIPT], ros_arguments=arguments)
    ])
"""
SCRIPT = """
import rclpy
from geometry_msgs.msg import Twist

rclpy.init()
node = rclpy.create_node("planner")
publisher = node.create_publisher(Twist, "cmd_vel", 1)
print("publishes", publisher.topic_name, flush=True)
message = Twist()
message.linear.x = 0.7
node.create_timer(0.05, lambda: publisher.publish(message))
rclpy.spin(node)
"""

SERVICES_OF_ACTIONS = ("send_goal", "cancel_goal", "get_result")
TOPICS_OF_ACTIONS = ("feedback", "status")

# What the node uses with other settings: a lifecycle manager, simulated time.
SELDOM = {"publish": {"/bond"}, "subscribe": {"/bond", "/clock"}}


def rights(text: str) -> dict[str, set[str]]:
    """The permissions of the first enclave in a policy. Actions appear as their topics and
    services.
    """
    profile = next(ET.fromstring(text).iter("profile"))
    found: dict[str, set[str]] = {
        each: set() for each in ("publish", "subscribe", "reply", "request")
    }
    for group in profile:
        ((right, verdict),) = group.attrib.items()
        assert verdict == "ALLOW"
        names = [full(str(each.text)) for each in group]
        if right in found:
            found[right].update(names)
            continue
        asks, tells = ("request", "subscribe") if right == "call" else ("reply", "publish")
        for name in names:
            found[asks] |= {f"{name}/_action/{each}" for each in SERVICES_OF_ACTIONS}
            found[tells] |= {f"{name}/_action/{each}" for each in TOPICS_OF_ACTIONS}
    return found


def full(name: str) -> str:
    """A name of the profile in the root namespace."""
    return name.replace("~", f"/{NODE}") if name[0] in "~/" else f"/{name}"


def test_the_policy_is_what_the_node_uses(
    ros2: Ros2, start: Callable[..., Process], started: list[Process]
) -> None:
    start()
    looking = ros2.ears(NODE, script="ros2_graph.py")
    started.append(looking)
    policy = rights(security.policy(machine_of_vehicle("ros2")))
    assert looking.running.stdout is not None
    for line in looking.running.stdout:
        used = {right: set(names) for right, names in json.loads(line).items()}
        if f"/{NODE}/bypassed" in used.get("publish", ()) and "/lamp" in used["request"]:
            break
    for right, names in policy.items():
        assert used[right] <= names, right
        unused = {each for each in names - used[right] if "/_action/" not in each}
        assert unused <= SELDOM.get(right, set()), right


@pytest.fixture
def secured(ros2: Ros2, vehicle: Path, tmp_path: Path) -> Iterator[Mapping[str, str]]:
    """Everything that is started is under access control; the robot may do all."""
    assert vehicle.exists()
    keystore, policy = tmp_path / "keystore", tmp_path / "policy.xml"
    policy.write_text(security.policy(machine_of_vehicle("ros2")), encoding="utf-8")

    def make(*arguments: object) -> None:
        command = ["ros2", "security", *map(str, arguments)]
        done = subprocess.run(command, env=ros2.variables, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr

    make("create_keystore", keystore)
    for enclave in (*ENCLAVES, "/robot"):
        make("create_enclave", keystore, enclave)
    for enclave in ENCLAVES:
        make("create_permission", keystore, enclave, policy)
    before = dict(ros2.variables)
    ros2.variables |= {
        "ROS_SECURITY_KEYSTORE": str(keystore),
        "ROS_SECURITY_ENABLE": "true",
        "ROS_SECURITY_STRATEGY": "Enforce",
    }
    try:
        yield ros2.variables
    finally:
        ros2.variables.clear()
        ros2.variables |= before


@pytest.fixture
def guarded(ros2: Ros2, secured: dict[str, str]) -> Iterator[Robot]:
    """The robot, without a planner."""
    secured["ROS_SECURITY_ENCLAVE_OVERRIDE"] = "/robot"
    robot = ros2.robot()
    del secured["ROS_SECURITY_ENCLAVE_OVERRIDE"]
    try:
        robot.set(pitch=0.0, speed=None)
        yield robot
    finally:
        robot.end()


@needs(SROS2)
def test_under_access_control_the_planner_reaches_the_robot_through_the_filter_only(
    ros2: Ros2, guarded: Robot, started: list[Process], tmp_path: Path
) -> None:
    parameters = {"state_file": str(tmp_path / "latched"), "patience": 60.0}
    planner = PLANNER.format(script=SCRIPT)
    started.append(ros2.launch_behind(planner, tmp_path, parameters))
    guarded.passes(0.7)
    guarded.set(pitch=15.0)
    guarded.passes(0.2)
    guarded.stays_at(0.2)
    directly = ["python3", "-c", SCRIPT, "--ros-args", "--enclave", ENCLAVES[1]]
    started.append(Process(directly, ros2.variables, tmp_path / "directly.log"))
    until(lambda: started[-1].running.poll() is not None, "the planner is refused")
    assert started[-1].running.poll() != 0
    guarded.stays_at(0.2)
