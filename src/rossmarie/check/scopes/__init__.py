"""Declarations, and the state of the checker."""
