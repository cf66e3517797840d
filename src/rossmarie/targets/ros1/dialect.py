"""The C++ of ROS 1: `geometry_msgs::Twist` of `geometry_msgs/Twist.h`."""

from __future__ import annotations

from rossmarie.targets.ros.dialect import Dialect, Interface, bare_name, message_package


def _cpp_type(ros_type: str, interface: Interface) -> str:
    suffix = "Goal" if interface is Interface.ACTION else ""
    return f"{message_package(ros_type)}::{bare_name(ros_type)}{suffix}"


def _header(ros_type: str, interface: Interface) -> str:
    suffix = "Action" if interface is Interface.ACTION else ""
    return f"{message_package(ros_type)}/{bare_name(ros_type)}{suffix}.h"


ROS1 = Dialect(
    name="ros1",
    templates="rossmarie.targets.ros1",
    cpp_type=_cpp_type,
    header=_header,
    primitives={"time": "time", "duration": "duration"},
)
