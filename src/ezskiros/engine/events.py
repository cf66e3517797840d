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
    """One of several things was inferred."""
    RUNNING = "running"
    """A skill says something new of its progress."""
    SUCCEEDED = "succeeded"
    FAILED = "failed"
    PREEMPTED = "preempted"


class Code(enum.IntEnum):
    """The number that SkiROS2 tells in place of the progress of a skill; POST is ours."""

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
    """Something that happened to a skill.

    `path` has the names of the skills from the root on; of several children with the same name all
    but the first have a number, such as `Wait#2`. `code` and `text` are its progress, as SkiROS2
    has it; `values` are those of its parameters when it starts, empty else.
    """

    happened: Happened
    path: tuple[str, ...]
    skill: str
    implementation: str
    code: int
    text: str
    values: Mapping[str, Any]
