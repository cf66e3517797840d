"""The error with the reason why a process cannot be confined."""

from __future__ import annotations


class UnconfinedError(Exception):
    """The system offers no confinement. The text gives the reason."""
