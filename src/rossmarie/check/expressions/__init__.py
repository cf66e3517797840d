"""Expressions: the type of each, and the value of those that are constant."""
