"""A program that has been checked: every name resolved, every type and unit known to fit.

Comes out of `check`; `lowering` is its only reader. Holds the syntax tree and, beside it, what the
checker found out about it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path as FilePath

from dslkit.source import SourceFile, Span
from rossmarie.check.effects import CheckedEffect
from rossmarie.check.frames import FrameTree
from rossmarie.core import Region
from rossmarie.ir import Edge, Path, Quantity
from rossmarie.ir.filing import Category, LeftOut
from rossmarie.ir.reactions import CommandTopic
from rossmarie.ir.script import Script
from rossmarie.skills import Closure, Place, SkillFile, span_at
from rossmarie.syntax import ast
from rossmarie.syntax.node_map import NodeMap
from rossmarie.types import Type
from rossmarie.units import Unit

ConditionKey = tuple[str, str]
"""The names of an entity and of a condition in it."""


Gaps = tuple[int, int]
"""The least and the greatest time between two messages of a topic, in nanoseconds."""


@dataclass(frozen=True)
class Value:
    """The value of a constant expression: numbers in SI (one, or 2 for an interval, 6 for a box),
    or a boolean, or a text.
    """

    type: Type
    numbers: tuple[float, ...] = ()
    boolean: bool | None = None
    text: str | None = None


@dataclass(frozen=True)
class CheckedInput:
    """An input with its topic, message type and field path resolved.

    `topic` is the full name (`/imu/data`), `message_type` is `sensor_msgs/Imu`, `path` leads to the
    selected field (empty: the whole message; the `data` of a std_msgs message is part of it).
    `most` is the number of elements that lists of the message may have. A number of a skill has a
    `query` instead of a path, the transform of a frame an `edge`. `whole` is the message, its
    headers say the frame `source`, and rules see it in the frame `target`: None where nobody says.
    """

    declaration: ast.Input
    topic: str
    message_type: str
    path: tuple[str, ...]
    type: Type
    timeout_ns: int | None
    most: int | None = None
    query: Quantity | None = None
    whole: Type | None = None
    source: str | None = None
    target: str | None = None
    edge: Edge | None = None

    @property
    def frame(self) -> str | None:
        """The frame in which rules see it, if that is known."""
        return self.source if self.target is None else self.target

    @property
    def base(self) -> Path:
        """The way from the message to what the input selects."""
        return self.path if self.query is None else (self.query,)

    @property
    def field(self) -> str:
        """The words for what the input selects: `sensor_msgs/Imu.orientation`, `Push.Speed`."""
        if self.query is not None:
            return str(self.query)
        return ".".join((self.message_type, *self.path))


PERIODS_OF_TIMEOUT = 5
"""The periods of the context that are missed until it is stale, where the rules say no time."""


@dataclass(frozen=True)
class CheckedDoing:
    """A query to the skills that run, closed: `skills` and the classes of each of `arguments`
    hold all that are derived, sorted. `text` is how it is written; `permits` are the permissions
    of the skill, in words.
    """

    skills: tuple[str, ...]
    arguments: tuple[tuple[str, tuple[str, ...]], ...]
    text: str
    permits: tuple[str, ...]


@dataclass(frozen=True)
class CheckedSkills:
    """The file of skills of a program. `timeout_ns` is that of its context."""

    file: SkillFile
    source: SourceFile
    declaration: ast.Skills
    timeout_ns: int

    @property
    def folder(self) -> FilePath:
        """The folder of the file, to which its places are relative."""
        return FilePath(self.source.path).parent

    @cached_property
    def classes(self) -> Closure:
        """The classes, and those derived from them."""
        return Closure({name: each.parents for name, each in self.file.classes.items()})

    @cached_property
    def skills(self) -> Closure:
        """The skills, and those derived from them."""
        return Closure({name: each.parents for name, each in self.file.skills.items()})

    def span_at(self, place: Place | None) -> Span | None:
        """A place in the skills, if it can be shown."""
        return span_at(place, self.folder)


@dataclass(frozen=True)
class CheckedFeedback:
    """The amounts that a learner loses by a rule, and the unit of its margin if it declares one."""

    per_activation: float
    per_second: float
    margin: Unit | None


@dataclass(frozen=True)
class CheckedMotion:
    """A motion of the robot, numbers in SI. `brake` is the least deceleration, `latency_s` the time
    from a message to the brakes beside the silence of `timeout_s` after which a message is missed.
    `is_of_one_message` tells that position and speed come together; `inputs` are those it rests on.
    """

    declaration: ast.Motion
    position: ast.Expression
    speed: ast.Expression
    brake: float
    acceleration: float
    fastest: float
    latency_s: float
    timeout_s: float
    is_of_one_message: bool
    inputs: tuple[str, ...]

    @property
    def reaction_s(self) -> float:
        """The longest time from what the last message told to the brakes."""
        return self.timeout_s + self.latency_s


@dataclass(frozen=True)
class CheckedKeeps:
    """The speed in m/s that a rule keeps a motion below in a zone or in the places of a class, in a
    frame.
    """

    motion: CheckedMotion
    speed: float
    region: Region
    frame: str
    written: ast.Keeps


@dataclass(frozen=True)
class Symbols:
    """The meaning of each name."""

    constants: Mapping[str, Value]
    inputs: Mapping[str, CheckedInput]
    conditions: Mapping[ConditionKey, ast.Condition]
    actions: Mapping[str, ast.Action]


@dataclass(frozen=True)
class CheckedProgram:
    """The result of a check without errors.

    `name` is the stem of the main file. `types` holds every expression that is reachable from
    conditions, rules and contracts, `values` those that are constant (literals, constants and
    operators on them; durations; interval and box literals). `rules` are in file order, imported
    files first; `order` are their numbers, the most important first, `priorities` the pairs that
    were put in an order, `unless` of each rule those that it gives way to. `effects` are those of
    each action, `commands` the topics that may pass through the safety filter; `gaps` are those of
    topics whose rate is declared; `feedback` and `categories` are
    those of each rule, `left_out` what a selection does not hold. `read_files` are the definitions
    of messages that were read, those that come with this program left out, and the file of skills.
    `doing` holds what each query to the skills asks, `regions` what the name of each class and
    zone stands for, `motions` the motions by name. `keeps` is what each rule keeps.
    `frame_inputs` are the inputs that frames come by, by the frame.
    """

    name: str
    symbols: Symbols
    rules: tuple[ast.Rule, ...]
    types: NodeMap[Type]
    values: NodeMap[Value]
    effects: Mapping[str, tuple[CheckedEffect, ...]]
    commands: Mapping[str, CommandTopic]
    order: tuple[int, ...]
    priorities: tuple[tuple[int, int], ...]
    unless: tuple[tuple[int, ...], ...]
    hazards: Mapping[str, ast.Hazard]
    gaps: Mapping[str, Gaps]
    skills: CheckedSkills | None
    doing: NodeMap[CheckedDoing]
    regions: NodeMap[Region]
    motions: Mapping[str, CheckedMotion]
    frames: FrameTree
    frame_inputs: Mapping[str, CheckedInput]
    feedback: tuple[CheckedFeedback, ...] = ()
    categories: tuple[tuple[Category, ...], ...] = ()
    keeps: tuple[CheckedKeeps | None, ...] = ()
    left_out: LeftOut | None = None
    read_files: tuple[SourceFile, ...] = ()
    tests: tuple[Script, ...] = ()
