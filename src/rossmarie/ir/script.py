"""Tests as data: what arrives when, in SI, and what is expected of the rules.

A script names fields as the user does, by input and path, also those that no rule reads; how it
becomes messages of a machine is up to `rossmarie.testing`. Instants count from its beginning.
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
"""In SI; a tuple is a whole array, None is unknown."""


@dataclass(frozen=True)
class FieldValue:
    """One field of the messages of a topic gets a value; `path` leads there from the message,
    `input` is by which input the user named it. With an `angle` (`roll`, `pitch` or `yaw`), `path`
    leads to an orientation, of which the other two angles stay as they are. `unit` is only how the
    value is to be written; nothing: in the unit of the message. `span` is None in a script that
    nobody wrote down yet.
    """

    input: str
    topic: str
    path: Path
    value: SettingValue
    angle: str | None = None
    unit: str = field(default="", compare=False)
    span: Span | None = field(default=None, compare=False)


@dataclass(frozen=True)
class Running:
    """The skills that run and that can start next, and no others, from this message on `topic` on;
    `text` is how a test says so.
    """

    topic: str
    skills: tuple[RunningSkill, ...]
    text: str = field(compare=False)


@dataclass(frozen=True)
class ScriptedArrival:
    """A message on each of `topics`, which the user named by `inputs`, at `first_ns`, and with a
    period again and again up to and including `last_ns`. `running` says which skills the one of
    them tells of that tells of skills; None if they are those of before.
    """

    first_ns: int
    last_ns: int
    period_ns: int | None
    inputs: tuple[str, ...]
    topics: tuple[str, ...]
    settings: tuple[FieldValue, ...]
    running: Running | None = None

    @property
    def count(self) -> int:
        """The number of messages that come on each of the topics."""
        return 1 if self.period_ns is None else (self.last_ns - self.first_ns) // self.period_ns + 1


@dataclass(frozen=True)
class ScriptedReset:
    """An operator resets one latched rule, by index, or all."""

    at_ns: int
    rule: int | None


@dataclass(frozen=True)
class Expectation:
    """A rule is active, or inactive, at every instant from `first_ns` to `last_ns`, both included.

    `span` is None in a script that nobody wrote down yet.
    """

    rule: int
    is_active: bool
    first_ns: int
    last_ns: int
    span: Span | None


@dataclass(frozen=True)
class CommandExpectation:
    """The expectation that what the safety filter lets through in a field of a command lies in
    `[low, high]`, whatever comes in, at every instant from `first_ns` to `last_ns`, both included;
    in the unit of the message, which is `unit`.
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
        """The last instant that matters."""
        ends = [event.at_ns if isinstance(event, ScriptedReset) else event.last_ns
                for event in self.events]  # fmt: skip
        ends += [expected.last_ns for expected in self.expectations]
        ends += [expected.last_ns for expected in self.commands]
        return max([0, *ends])

    @property
    def can_be_written(self) -> bool:
        """Say whether a test may be so long."""
        repeated = (each for each in self.events if isinstance(each, ScriptedArrival))
        return self.end_ns <= LATEST_NS and all(each.count <= MOST_MESSAGES for each in repeated)
