"""The message types for which there are first rules."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from rossmarie.starter.arm import Joints, WristForces
from rossmarie.starter.base import Inertia, Odometry, ScannerDistances
from rossmarie.starter.robot import MessageRules
from rossmarie.starter.supply import Battery, Diagnostics, Heat

KINDS: Mapping[str, Callable[[], MessageRules]] = {
    "nav_msgs/Odometry": Odometry,
    "sensor_msgs/Imu": Inertia,
    "sensor_msgs/LaserScan": ScannerDistances,
    "sensor_msgs/JointState": Joints,
    "geometry_msgs/WrenchStamped": lambda: WristForces(".wrench"),
    "geometry_msgs/Wrench": lambda: WristForces(""),
    "sensor_msgs/BatteryState": Battery,
    "sensor_msgs/Temperature": Heat,
    "diagnostic_msgs/DiagnosticArray": Diagnostics,
}
"""A class for the messages of each type, in the order in which rules are written."""

OWN = "/diagnostics"
"""The topic on which the node of the rules also publishes, so that its silence has no meaning
(ROSS256).
"""

ARM = frozenset({"joints", "wrench"})
"""The kinds of messages of an arm without a base."""
