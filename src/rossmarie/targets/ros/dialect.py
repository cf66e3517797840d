"""Differences between ROS 1 and ROS 2 in generated C++: the names of types and of their headers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

from rossmarie.ir import reactions


class RosInterface(Enum):
    """The kind of interface of a type; the value is the folder of its definition."""

    MESSAGE = "msg"
    SERVICE = "srv"
    ACTION = "action"


class RuntimePart(NamedTuple):
    """A header of the runtime with the class of a task, and packages that it uses."""

    header: str
    packages: tuple[str, ...]


@dataclass(frozen=True)
class Dialect:
    """One generation of ROS.

    `generation` is its usual name, `folder` the name of its folders. `cpp_type` gives the C++ type
    of `sensor_msgs/Imu`, and `header` the file that declares it. `primitives` are the types of
    instants and durations in .msg files. `parts` are for effects that need more than a task.
    `relay` is for goals that are sent again, if the node cannot observe other nodes' goals. An
    action server publishes the status of its goals on the topic of its name and `status_topic`.
    """

    generation: str
    folder: str
    cpp_type: Callable[[str, RosInterface], str]
    header: Callable[[str, RosInterface], str]
    primitives: Mapping[str, str]
    parts: Mapping[type[reactions.Effect], RuntimePart]
    status_topic: str
    relay: RuntimePart | None = None


def message_package(ros_type: str) -> str:
    """The package of `sensor_msgs/Imu`."""
    return ros_type.partition("/")[0]


def bare_name(ros_type: str) -> str:
    """`Imu` of `sensor_msgs/Imu`."""
    return ros_type.rpartition("/")[2]
