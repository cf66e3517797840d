"""Lowering: from a checked program to the monitor machine."""

from rossmarie.lowering.lower import lower
from rossmarie.lowering.requirements import lower_requirements
from rossmarie.lowering.tightening import misdirected

__all__ = ["lower", "lower_requirements", "misdirected"]
