"""Operators, functions and ranges, and what they are applied to."""
