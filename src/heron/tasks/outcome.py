"""The state of a task."""

from __future__ import annotations

import enum


class TaskStatus(enum.Enum):
    """A task is under way, or over."""

    RUNNING = "running"
    COMPLETED = "completed"
    GIVEN_UP = "given up"
