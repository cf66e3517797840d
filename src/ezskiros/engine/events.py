"""The events of running skills, and their reasons."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple


class Happened(enum.Enum):
    """The kinds of events."""

    STARTED = "started"
    CHOSEN = "chosen"
    """One of several individuals was inferred."""
    RUNNING = "running"
    """A skill reports new progress."""
    SUCCEEDED = "succeeded"
    FAILED = "failed"
    PREEMPTED = "preempted"


class Code(enum.IntEnum):
    """The number that SkiROS2 reports as the progress of a failed skill. POST exists only here."""

    END = 1
    PRE = -1
    HOLD = -2
    POST = -3
    START = -404
    EXECUTION = -405
    PREEMPTION = -406


@dataclass(frozen=True)
class Reason:
    """The reason why a skill has failed."""

    code: int
    text: str


class Event(NamedTuple):
    """An event of a skill.

    `path` has the names of the skills from the root. If several children have the same name, all
    except the first have a number, such as `Wait#2`. `code` and `text` are the progress, as in
    SkiROS2. At a start, `values` are the values of the parameters; otherwise it is empty.
    """

    happened: Happened
    path: tuple[str, ...]
    skill: str
    implementation: str
    code: int
    text: str
    values: Mapping[str, Any]
