"""The ROS 2 target: an ament package with a node that monitors, acts, and filters commands."""

from rossmarie.targets.base import Target
from rossmarie.targets.ros.package import OWNED_BY_USER
from rossmarie.targets.ros2.package import generate, next_step
from rossmarie.targets.ros2.unsupported import unsupported

TARGET = Target("ros2", unsupported, generate, OWNED_BY_USER, next_step, is_package=True)

__all__ = ["TARGET", "generate", "unsupported"]
