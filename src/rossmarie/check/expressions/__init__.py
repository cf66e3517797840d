"""Expressions: the type of each expression, and the values of constant expressions."""
