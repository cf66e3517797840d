"""A checked program: all names are resolved, and all types and units fit.

`check` creates it, and only `lowering` reads it. It contains the syntax tree and the results of the
checker.
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
from rossmarie.skills import Closure, SkillFile, SourcePlace, span_at
from rossmarie.syntax import ast
from rossmarie.syntax.node_map import NodeMap
from rossmarie.types import Type
from rossmarie.units import Unit

ConditionKey = tuple[str, str]
"""The names of an entity and of a condition in it."""


Gaps = tuple[int, int]
"""The least and the greatest time in ns between two messages of a topic."""


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
    `most` is the greatest number of elements that lists of the message may have. A number of a
    skill has a `query` instead of a path, the transform of a frame has an `edge`. `whole` is the
    type of the message. `source` is the frame in the headers of its messages, and `target` the
    frame in which rules use it; both are None if unknown.
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
        """The frame in which rules use the input, if it is known."""
        return self.source if self.target is None else self.target

    @property
    def base(self) -> Path:
        """The path from the message to the selected part."""
        return self.path if self.query is None else (self.query,)

    @property
    def field(self) -> str:
        """The selected part in words: `sensor_msgs/Imu.orientation`, `Push.Speed`."""
        if self.query is not None:
            return str(self.query)
        return ".".join((self.message_type, *self.path))


PERIODS_OF_TIMEOUT = 5
"""The number of missed periods of the context after which it is stale, if the rules give no
timeout.
"""


@dataclass(frozen=True)
class CheckedDoing:
    """A query about the running skills, closed: `skills` and the classes of each of `arguments`
    include all derived ones, sorted. `text` is the query as written. `permits` are the permissions
    of the skill, in words.
    """

    skills: tuple[str, ...]
    arguments: tuple[tuple[str, tuple[str, ...]], ...]
    text: str
    permits: tuple[str, ...]


@dataclass(frozen=True)
class CheckedSkills:
    """The skills file of a program. `timeout_ns` is the timeout of its context."""

    file: SkillFile
    source: SourceFile
    declaration: ast.Skills
    timeout_ns: int

    @property
    def folder(self) -> FilePath:
        """The folder of the file; its places are relative to this folder."""
        return FilePath(self.source.path).parent

    @cached_property
    def classes(self) -> Closure:
        """The classes and their subclasses."""
        return Closure({name: each.parents for name, each in self.file.classes.items()})

    @cached_property
    def skills(self) -> Closure:
        """The skills, and the skills derived from them."""
        return Closure({name: each.parents for name, each in self.file.skills.items()})

    def span_at(self, place: SourcePlace | None) -> Span | None:
        """A place in the source of the skills, if it can be shown."""
        return span_at(place, self.folder)


@dataclass(frozen=True)
class CheckedFeedback:
    """The cost of a rule to a learner, and the unit of its margin if it declares one."""

    per_activation: float
    per_second: float
    margin: Unit | None


@dataclass(frozen=True)
class CheckedMotion:
    """A motion of the robot, with numbers in SI. `brake` is the least deceleration. `latency_s` is
    the time from a message to the brakes, and `timeout_s` the silence after which a message counts
    as missed. `is_of_one_message` is True if one message has both position and speed. `inputs` are
    the inputs that the motion depends on.
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
        """The longest time in seconds from the state in the last message to the brakes."""
        return self.timeout_s + self.latency_s


@dataclass(frozen=True)
class CheckedKeeps:
    """The requirement of a rule: the motion stays below a speed in m/s in a zone, or in the
    locations of a class, in a frame.
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

    - `name` is the stem of the main file.
    - `types` contains every expression that is reachable from conditions, rules and contracts.
    - `values` contains the constant ones: literals, constants and operators on them; durations;
      interval and box literals.
    - `rules` are in file order, imported files first. `order` contains their numbers, the most
      important first. `priorities` are the pairs that the user has ordered. For each rule, `unless`
      contains the rules to which it gives way.
    - `effects` are the effects of each action; `commands` are the topics that may pass through the
      safety filter.
    - `gaps` contains the topics with a declared rate.
    - `feedback` and `categories` belong to each rule. `left_out` are the rules outside a selection.
    - `read_files` are the message definitions that were read, without the built-in ones, and the
      skills file.
    - `doing` contains each query about skills, `regions` the meaning of the name of each class and
      zone, and `motions` the motions by name.
    - `keeps` is the requirement of each rule; `frame_inputs` are the inputs for frames, by frame.
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
