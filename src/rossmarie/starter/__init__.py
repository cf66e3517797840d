"""First rules for a robot, written from one recording of the robot.

`begin` reads a recording and returns the texts of a system model, and of rules with their tests.
"""

from rossmarie.starter.beginning import Beginning, begin
from rossmarie.starter.errors import ALL

__all__ = ["ALL", "Beginning", "begin"]
