"""The check: syntax trees in, a checked program or findings out."""

from rossmarie.check.check import CheckOptions, check
from rossmarie.check.model import CheckedInput, CheckedProgram, Symbols, Value
from rossmarie.check.rules.selecting import select

__all__ = ["CheckOptions", "CheckedInput", "CheckedProgram", "Symbols", "Value", "check", "select"]
