"""Constructors of the ROS messages that the robot uses.

The classes come from rosbags for ROS 1: plain data with the fields of the definitions.
"""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore
from rosbags.typesys.stores import ros1_noetic

from rossmarie.ir import TRANSFORMS
from rossmarie.types.definitions import own_texts

__all__ = [
    "Bool",
    "Float64",
    "Imu",
    "JointState",
    "LaserScan",
    "Message",
    "Odometry",
    "Point",
    "PoseWithCovarianceStamped",
    "Quaternion",
    "Time",
    "Twist",
    "Vector3",
    "Wrench",
    "WrenchStamped",
    "full_name",
    "header",
    "imu",
    "instant",
    "joint_state",
    "laser_scan",
    "message_class",
    "new_message",
    "odometry",
    "quaternion_about_z",
    "stamped_pose",
    "store",
    "transform_on_floor",
    "twist",
    "type_name",
    "wrench",
    "yaw_of",
]

Time = ros1_noetic.builtin_interfaces__msg__Time
Point = ros1_noetic.geometry_msgs__msg__Point
Pose = ros1_noetic.geometry_msgs__msg__Pose
PoseWithCovariance = ros1_noetic.geometry_msgs__msg__PoseWithCovariance
PoseWithCovarianceStamped = ros1_noetic.geometry_msgs__msg__PoseWithCovarianceStamped
Quaternion = ros1_noetic.geometry_msgs__msg__Quaternion
Twist = ros1_noetic.geometry_msgs__msg__Twist
TwistWithCovariance = ros1_noetic.geometry_msgs__msg__TwistWithCovariance
Vector3 = ros1_noetic.geometry_msgs__msg__Vector3
Odometry = ros1_noetic.nav_msgs__msg__Odometry
Imu = ros1_noetic.sensor_msgs__msg__Imu
JointState = ros1_noetic.sensor_msgs__msg__JointState
LaserScan = ros1_noetic.sensor_msgs__msg__LaserScan
Bool = ros1_noetic.std_msgs__msg__Bool
Float64 = ros1_noetic.std_msgs__msg__Float64
Header = ros1_noetic.std_msgs__msg__Header
Wrench = ros1_noetic.geometry_msgs__msg__Wrench
WrenchStamped = ros1_noetic.geometry_msgs__msg__WrenchStamped

Message = Any
"""A message: of one of the classes here, or of `message_class`."""

Floats = NDArray[np.float64]
Angles = tuple[float, float, float]
"""The first, the last, and the step between them (rad)."""
_ZEROS = {"bool": False, "string": "", "float32": 0.0, "float64": 0.0}


def type_name(message_class: type) -> str:
    """`sensor_msgs/Imu`."""
    name: str = message_class.__msgtype__  # type: ignore[attr-defined]
    return name.replace("/msg/", "/")


def message_class(name: str) -> type:
    """The class of messages of a type such as `std_msgs/Bool`. Raises `KeyError`."""
    found: type = store().types[full_name(name)]
    return found


def new_message(name: str) -> Message:
    """A message with all fields zero, false or empty."""
    known = store()
    _, fields = known.fielddefs[full_name(name)]
    return known.types[full_name(name)](*(_new_field(kind) for _, kind in fields))


def _new_field(description: Any) -> Any:
    kind, detail = description
    if kind == Nodetype.NAME:
        return new_message(detail)
    if kind == Nodetype.BASE:
        return _ZEROS.get(detail[0], 0)
    (element_kind, element), count = detail
    if element_kind == Nodetype.BASE and element[0] != "string":
        return np.zeros(count, element[0])
    return [_new_field(detail[0]) for _ in range(count)]


def full_name(name: str) -> str:
    """`sensor_msgs/msg/Imu`, as rosbags has it."""
    return name if "/msg/" in name else name.replace("/", "/msg/")


@cache
def store(kind: Stores = Stores.ROS1_NOETIC) -> Typestore:
    """All known types: the types of ROS, of transforms, and of messages about running skills."""
    known = get_typestore(kind)
    for name, text in own_texts().items():
        known.register(get_types_from_msg(text, full_name(name)))
    if full_name(TRANSFORMS) not in known.types:
        transforms = "geometry_msgs/TransformStamped[] transforms\n"
        known.register(get_types_from_msg(transforms, full_name(TRANSFORMS)))
    return known


# --- makers ----------------------------------------------------------------------------------


def twist(linear_x: float, angular_z: float) -> Message:
    """A velocity command for a base that cannot go sideways."""
    return Twist(Vector3(linear_x, 0.0, 0.0), Vector3(0.0, 0.0, angular_z))


def imu(
    at_ns: int,
    orientation: Message,
    rates: tuple[float, float, float],
    acceleration: tuple[float, float, float],
) -> Message:
    """A reading of an inertial measurement unit; its covariances are not known."""
    none = np.zeros(9)
    return Imu(
        header(at_ns, "imu"), orientation, none, Vector3(*rates), none, Vector3(*acceleration), none
    )


def odometry(at_ns: int, x: float, y: float, yaw: float, velocity: Message) -> Message:
    """The pose and velocity of the base from wheel odometry."""
    pose = PoseWithCovariance(_pose(x, y, yaw), np.zeros(36))
    return Odometry(
        header(at_ns, "odom"), "base_link", pose, TwistWithCovariance(velocity, np.zeros(36))
    )


def transform_on_floor(
    at_ns: int, parent: str, child: str, place: tuple[float, float, float]
) -> Message:
    """A message with one transform: how a frame lies in its parent, by x and y (m) and a turn on
    the floor (rad).
    """
    x, y, yaw = place
    found = new_message("geometry_msgs/TransformStamped")
    found.header, found.child_frame_id = header(at_ns, parent), child
    found.transform.translation = Vector3(x, y, 0.0)
    found.transform.rotation = quaternion_about_z(yaw)
    return message_class(TRANSFORMS)([found])


def stamped_pose(at_ns: int, x: float, y: float, yaw: float) -> Message:
    """The pose of the base on the map."""
    pose = PoseWithCovariance(_pose(x, y, yaw), np.zeros(36))
    return PoseWithCovarianceStamped(header(at_ns, "map"), pose)


def wrench(at_ns: int, force: tuple[float, float, float]) -> Message:
    """The force that pushes the hand; torques are not measured."""
    return WrenchStamped(header(at_ns, "wrist"), Wrench(Vector3(*force), Vector3(0.0, 0.0, 0.0)))


def laser_scan(
    at_ns: int, angles: Angles, reach: tuple[float, float], ranges: NDArray[np.float32]
) -> Message:
    """A scan of a whole turn; a beam that nothing sends back has an infinite range."""
    first, last, step = angles
    none = np.zeros(0, dtype=np.float32)
    return LaserScan(header(at_ns, "scanner"), first, last, step, 0.0, 0.0, *reach, ranges, none)


def joint_state(
    at_ns: int, names: list[str], positions: Floats, velocities: Floats, efforts: Floats
) -> Message:
    """The positions (rad), velocities (rad/s) and torques (Nm) of the joints."""
    return JointState(header(at_ns, ""), names, positions, velocities, efforts)


def _pose(x: float, y: float, yaw: float) -> Message:
    return Pose(Point(x, y, 0.0), quaternion_about_z(yaw))


def header(at_ns: int, frame: str) -> Message:
    """A header: a time stamp, and the frame that numbers are in."""
    return Header(0, instant(at_ns), frame)


def instant(at_ns: int) -> Message:
    """A time stamp."""
    return Time(*divmod(at_ns, 1_000_000_000))


def quaternion_about_z(yaw: float) -> Message:
    """A turn on a level floor."""
    return Quaternion(0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))


def yaw_of(orientation: Message) -> float:
    """The turn on the floor of an orientation."""
    x, y, z, w = orientation.x, orientation.y, orientation.z, orientation.w
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
