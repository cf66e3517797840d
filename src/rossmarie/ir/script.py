"""Tests as data: messages with their instants, in SI, and expectations about the rules.

A script names fields as the user does, by input and path, including fields that no rule reads.
`rossmarie.testing` turns it into messages of a machine. Instants count from the beginning of the
script.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from dslkit.source import Span
from rossmarie.ir.path import Path
from rossmarie.ir.skills import RunningSkill

LATEST_NS = 10**15
"""The last instant that a test can name."""

MOST_MESSAGES = 100_000
"""The most messages of one repetition."""

SettingValue = float | bool | str | tuple[float | bool, ...] | None
"""A value in SI. A tuple is a whole array, None is unknown."""


@dataclass(frozen=True)
class FieldValue:
    """A value for one field of the messages of a topic. `path` leads to the field from the message,
    `input` is the input that the user named. With an `angle` (`roll`, `pitch` or `yaw`), `path`
    leads to an orientation whose other two angles stay unchanged. `unit` is only the display unit
    of the value; if it is empty, the unit of the message is shown. `span` is None in a script
    without a text.
    """

    input: str
    topic: str
    path: Path
    value: SettingValue
    angle: str | None = None
    unit: str = field(default="", compare=False)
    span: Span | None = field(default=None, compare=False)


@dataclass(frozen=True)
class ScriptedSkills:
    """The skills that run and that can start next, and no other skills, from this message on
    `topic` on. `text` is the notation of tests.
    """

    topic: str
    skills: tuple[RunningSkill, ...]
    text: str = field(compare=False)


@dataclass(frozen=True)
class ScriptedArrival:
    """A message on each of `topics`, which the user named by `inputs`, at `first_ns`, and then once
    per period up to and including `last_ns`. For a message about skills, `running` contains the
    running skills; None if they have not changed.
    """

    first_ns: int
    last_ns: int
    period_ns: int | None
    inputs: tuple[str, ...]
    topics: tuple[str, ...]
    settings: tuple[FieldValue, ...]
    running: ScriptedSkills | None = None

    @property
    def count(self) -> int:
        """The number of messages on each of the topics."""
        return 1 if self.period_ns is None else (self.last_ns - self.first_ns) // self.period_ns + 1


@dataclass(frozen=True)
class ScriptedReset:
    """An operator resets one latched rule, given by its index, or all latched rules."""

    at_ns: int
    rule: int | None


@dataclass(frozen=True)
class Expectation:
    """A rule is active, or inactive, at every instant from `first_ns` to `last_ns`, both included.

    `span` is None in a script without a text.
    """

    rule: int
    is_active: bool
    first_ns: int
    last_ns: int
    span: Span | None


@dataclass(frozen=True)
class CommandExpectation:
    """An expectation about a field of a command: the output of the safety filter lies in `[low,
    high]`, whatever the input, at every instant from `first_ns` to `last_ns`, both included. Values
    are in the unit of the message, `unit`.
    """

    topic: str
    path: tuple[str | int, ...]
    low: float
    high: float
    unit: str
    first_ns: int
    last_ns: int
    span: Span


@dataclass(frozen=True)
class Script:
    """A test: events in the order in which they begin, and expectations of rules and commands."""

    name: str
    events: tuple[ScriptedArrival | ScriptedReset, ...]
    expectations: tuple[Expectation, ...]
    span: Span | None
    commands: tuple[CommandExpectation, ...] = ()

    @property
    def end_ns(self) -> int:
        """The last instant of any event or expectation."""
        ends = [event.at_ns if isinstance(event, ScriptedReset) else event.last_ns
                for event in self.events]  # fmt: skip
        ends += [expected.last_ns for expected in self.expectations]
        ends += [expected.last_ns for expected in self.commands]
        return max([0, *ends])

    @property
    def can_be_written(self) -> bool:
        """Say whether the script is short enough to be written as a test."""
        repeated = (each for each in self.events if isinstance(each, ScriptedArrival))
        return self.end_ns <= LATEST_NS and all(each.count <= MOST_MESSAGES for each in repeated)
