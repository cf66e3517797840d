"""Operators, functions and ranges, and their operands."""
