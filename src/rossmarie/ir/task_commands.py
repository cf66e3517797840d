"""The output of a reactor: task commands, states of tasks, and bounds on commands."""

from __future__ import annotations

import enum
import math
from dataclasses import dataclass
from typing import NamedTuple

from rossmarie.ir.verdict import Event


class TaskState(enum.IntEnum):
    """The state of a task."""

    IDLE = 0
    RUNNING = 1  # started; the node waits for its end
    HOLDING = 2  # in force until it is stopped
    WAITING = 3  # overruled; it starts again when its rule owns the resource
    DONE = 4
    FAILED = 5
    OVERDUE = 6  # overruled for longer than its timeout: it has failed, and starts again later


class TaskCommandKind(enum.Enum):
    """The kind of a task command: an instruction about a task, or a report about it."""

    START = "start"
    STOP = "stop"  # its rule was released: undo the task
    OVERRULED = "overruled"  # another rule has the resource: give the task up, or do not begin it
    FAILED = "failed"  # give the task up
    RETRACE = "retrace"  # send this pose


@dataclass(frozen=True)
class TaskCommand:
    """A task command to the owner of the reactor: an instruction, or a report. `by` is the rule
    that overrules. `pose` is the pose that a `retrace` sends: a position in m, and with an
    orientation its quaternion.
    """

    kind: TaskCommandKind
    task: int
    by: int | None = None
    pose: tuple[float, ...] = ()


class Reported(NamedTuple):
    """The output of a monitor and its reactor, each in order."""

    events: list[Event]
    task_commands: list[TaskCommand]

    def __bool__(self) -> bool:
        """Say whether there is any output."""
        return bool(self.events or self.task_commands)


@dataclass(frozen=True)
class FieldBounds:
    """The bounds on a field of a command: x becomes `min(max(x * factor, low), high)`, or 0 if x is
    not finite.
    """

    factor: float
    low: float
    high: float

    def of(self, value: float) -> float:
        """The bounded value of a number in a command."""
        if not math.isfinite(value):
            return 0.0
        return min(max(value * self.factor, self.low), self.high)
