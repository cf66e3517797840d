"""The check. Its input is syntax trees; its result is a checked program or findings."""

from rossmarie.check.check import CheckOptions, check
from rossmarie.check.model import CheckedInput, CheckedProgram, Symbols, Value
from rossmarie.check.rules.selecting import select

__all__ = ["CheckOptions", "CheckedInput", "CheckedProgram", "Symbols", "Value", "check", "select"]
