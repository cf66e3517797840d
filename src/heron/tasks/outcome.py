"""The state of a task."""

from __future__ import annotations

import enum


class TaskStatus(enum.Enum):
    """The state of a task: running or finished."""

    RUNNING = "running"
    COMPLETED = "completed"
    GIVEN_UP = "given up"
