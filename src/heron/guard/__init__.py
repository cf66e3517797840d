"""The safety node in this process: monitor, reactor and filter between programs and robot.

It performs the same actions as the generated ROS nodes, in the same order.
"""

from heron.guard.collision_monitor import ArmCollisionMonitor, BaseCollisionMonitor
from heron.guard.guard import InProcessGuard, InProcessLink
from heron.guard.model import Guard, Link, Occurrence, unfiltered, waiting
from heron.guard.performing import UnsupportedEffectError

__all__ = [
    "ArmCollisionMonitor",
    "BaseCollisionMonitor",
    "Guard",
    "InProcessGuard",
    "InProcessLink",
    "Link",
    "Occurrence",
    "UnsupportedEffectError",
    "unfiltered",
    "waiting",
]
