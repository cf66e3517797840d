"""From a checked program to the monitor machine."""

from rossmarie.lowering.lower import lower

__all__ = ["lower"]
