"""The C++ of ROS 2: `geometry_msgs::msg::Twist` of `geometry_msgs/msg/twist.hpp`."""

from __future__ import annotations

import re

from rossmarie.ir import reactions
from rossmarie.targets.ros.dialect import (
    Dialect,
    RosInterface,
    RuntimePart,
    bare_name,
    message_package,
)


def _cpp_type(ros_type: str, interface: RosInterface) -> str:
    return f"{message_package(ros_type)}::{interface.value}::{bare_name(ros_type)}"


def _header(ros_type: str, interface: RosInterface) -> str:
    return f"{message_package(ros_type)}/{interface.value}/{_file_name(bare_name(ros_type))}.hpp"


def _file_name(name: str) -> str:
    """`LaserScan` as `laser_scan`, as rosidl names its files."""
    words = re.sub(r"(.)([A-Z][a-z]+)", r"\1_\2", name)
    return re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", words).lower()


_GOAL_PACKAGES = ("action_msgs", "rclcpp_action")

ROS2 = Dialect(
    generation="ROS 2",
    folder="ros2",
    cpp_type=_cpp_type,
    header=_header,
    primitives={"time": "builtin_interfaces/Time", "duration": "builtin_interfaces/Duration"},
    parts={
        reactions.CancelGoal: RuntimePart("cancel_task.h", _GOAL_PACKAGES),
        reactions.SendGoal: RuntimePart("ros2/send_task.h", _GOAL_PACKAGES),
        reactions.SetParameter: RuntimePart("ros2/set_task.h", ()),
        reactions.SwitchControllers: RuntimePart("switch_task.h", ("controller_manager_msgs",)),
    },
    status_topic="/_action/status",
    relay=RuntimePart("ros2/relay.h", _GOAL_PACKAGES),
)
