"""The content of a generated ament package, without ROS."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest

from rossmarie.driver.build import generate
from rossmarie.targets import ros2
from rossmarie.targets.ros.dialect import RosInterface
from rossmarie.targets.ros2.dialect import ROS2
from support.compiled import machine_of
from support.live_cases import acting, vehicle


@pytest.mark.parametrize(
    ("name", "header"),
    [
        ("sensor_msgs/Imu", "sensor_msgs/msg/imu.hpp"),
        ("sensor_msgs/LaserScan", "sensor_msgs/msg/laser_scan.hpp"),
        ("sensor_msgs/PointCloud2", "sensor_msgs/msg/point_cloud2.hpp"),
        ("std_msgs/UInt8MultiArray", "std_msgs/msg/u_int8_multi_array.hpp"),
        ("nav_msgs/GetMapROSAction", "nav_msgs/msg/get_map_ros_action.hpp"),
    ],
)
def test_headers_are_called_as_rosidl_calls_them(name: str, header: str) -> None:
    assert ROS2.header(name, RosInterface.MESSAGE) == header


def test_packages_of_all_messages_are_named() -> None:
    files = generate(vehicle("ros2"), "ros2")
    depends = {each.text for each in ET.fromstring(files["package.xml"]).iter("depend")}
    assert depends == {
        "action_msgs",
        "arm_msgs",
        "bondcpp",
        "builtin_interfaces",
        "controller_manager_msgs",
        "diagnostic_msgs",
        "geometry_msgs",
        "lifecycle_msgs",
        "rcl_interfaces",
        "rclcpp",
        "rclcpp_action",
        "rclcpp_components",
        "rclcpp_lifecycle",
        "sensor_msgs",
        "std_msgs",
        "std_srvs",
    }
    for package in depends:
        assert f"\n  {package}" in files["needs.cmake"]


def test_the_planner_is_launched_behind_the_filter_and_the_relay() -> None:
    text = generate(vehicle("ros2"), "ros2")["launch/vehicle_safety.launch.py"]
    found: dict[str, object] = {}
    table = text.partition("REMAPPINGS = ")[2].partition("}")[0] + "}"
    exec(f"table = {table}", found)
    parts = ("send_goal", "cancel_goal", "get_result", "feedback", "status")
    goals = [f"{server}/_action/{part}" for server in ("arm", "hand") for part in parts]
    assert found["table"] == {
        "/cmd_vel": "/unfil_cmd_vel",
        "/arm_vel": "/unfil_arm_vel",
        **{f"/{each}": f"/unfil_{each}" for each in goals},
    }
    assert "respawn=True" in text


def test_goals_of_unknown_type_cannot_be_sent_again() -> None:
    machine = acting("cancel /arm within 1 sec then resend")
    (found,) = ros2.unsupported(machine)
    assert (found.code, found.title) == (
        "ROSS503",
        "the target ros2 cannot carry out `cancel /arm then resend`",
    )
    assert list(ros2.unsupported(acting("cancel /arm within 1 sec"))) == []
    assert list(ros2.unsupported(vehicle("ros2"))) == []


EFFECTS = {
    "cancel /arm within 1 sec": ({"cancel_task.h"}, {"action_msgs", "rclcpp_action"}),
    "send actionlib/Test { goal = 1; } to /arm within 1 sec": (
        {"ros2/send_task.h"},
        {"actionlib", "action_msgs", "rclcpp_action"},
    ),
    "send actionlib/Test { goal = 1; } to /arm within 1 sec then resend": (
        {"ros2/send_task.h", "ros2/relay.h"},
        {"actionlib", "action_msgs", "rclcpp_action"},
    ),
    "set /planner.FollowPath.speed to 1": ({"ros2/set_task.h"}, set()),
    "switch /manager { start a; }": (
        {"switch_task.h"},
        {"controller_manager_msgs"},
    ),
    'log info "x"': (set(), set()),
}
ALWAYS = {
    "bondcpp",
    "builtin_interfaces",
    "diagnostic_msgs",
    "geometry_msgs",
    "lifecycle_msgs",
    "rcl_interfaces",
    "rclcpp",
    "rclcpp_components",
    "rclcpp_lifecycle",
    "std_msgs",
}


@pytest.mark.parametrize("effect", EFFECTS)
def test_what_only_some_effects_need_is_there_for_these_only(effect: str) -> None:
    files = generate(acting(effect), "ros2")
    headers, packages = EFFECTS[effect]
    every = set().union(*(each for each, _ in EFFECTS.values()))
    text = files["src/rules.cpp"]
    assert {name for name in every if f'#include "runtime/{name}"' in text} == headers
    depends = {each.text for each in ET.fromstring(files["package.xml"]).iter("depend")}
    assert depends == ALWAYS | packages


def test_goals_that_are_only_sent_again_are_of_a_type_that_the_node_knows() -> None:
    rules = """
    system robot { server /arm : control_msgs/FollowJointTrajectory; }
    action hold { cancel /arm within 1 sec then resend; }
    input stop = topic /stop : std_msgs/Bool timeout 1 sec;
    rule r: if stop then { hold; };
    """
    files = generate(machine_of(rules), "ros2")
    header = "#include <control_msgs/action/follow_joint_trajectory.hpp>"
    assert header in files["src/rules.cpp"]
    assert "<depend>control_msgs</depend>" in files["package.xml"]
