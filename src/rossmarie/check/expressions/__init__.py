"""Expressions: the type of each, and the value of constant ones."""
