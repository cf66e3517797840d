"""Errors caused by other nodes."""

from __future__ import annotations


class Ros1Error(Exception):
    """The master, or the node on guard, is not there, or does not answer."""
