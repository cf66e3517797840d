"""Syntax trees -> checked program, or findings."""

from rossmarie.check.check import CheckOptions, check
from rossmarie.check.model import CheckedInput, CheckedProgram, Symbols, Value

__all__ = ["CheckOptions", "CheckedInput", "CheckedProgram", "Symbols", "Value", "check"]
