"""Declarations, and all that the checker knows while it goes over a program."""
