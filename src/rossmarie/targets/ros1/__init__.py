"""The ROS 1 target: a catkin package with a node that monitors, acts, and filters commands."""

from rossmarie.targets.base import Target
from rossmarie.targets.ros.package import OWNED_BY_USER
from rossmarie.targets.ros1.package import generate, next_step
from rossmarie.targets.ros1.unsupported import unsupported

TARGET = Target("ros1", unsupported, generate, OWNED_BY_USER, next_step, is_package=True)

__all__ = ["TARGET", "generate", "unsupported"]
