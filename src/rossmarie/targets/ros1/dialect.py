"""The C++ of ROS 1: `geometry_msgs::Twist` of `geometry_msgs/Twist.h`."""

from __future__ import annotations

from rossmarie.ir import reactions
from rossmarie.targets.ros.dialect import (
    Dialect,
    RosInterface,
    RuntimePart,
    bare_name,
    message_package,
)


def _cpp_type(ros_type: str, interface: RosInterface) -> str:
    return f"{message_package(ros_type)}::{_name(ros_type, interface)}"


def _header(ros_type: str, interface: RosInterface) -> str:
    return f"{message_package(ros_type)}/{_name(ros_type, interface)}.h"


def _name(ros_type: str, interface: RosInterface) -> str:
    return bare_name(ros_type) + ("Action" if interface is RosInterface.ACTION else "")


_GOAL_PACKAGES = ("actionlib_msgs", "topic_tools")

ROS1 = Dialect(
    generation="ROS 1",
    folder="ros1",
    cpp_type=_cpp_type,
    header=_header,
    primitives={"time": "time", "duration": "duration"},
    parts={
        reactions.CancelGoal: RuntimePart("cancel_task.h", _GOAL_PACKAGES),
        reactions.SendGoal: RuntimePart("ros1/send_task.h", _GOAL_PACKAGES),
        reactions.SetParameter: RuntimePart("ros1/set_task.h", ()),
        reactions.SwitchControllers: RuntimePart("switch_task.h", ("controller_manager_msgs",)),
    },
    status_topic="/status",
)
