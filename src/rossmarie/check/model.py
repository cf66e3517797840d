"""A program that has been checked: every name resolved, every type and unit known to fit.

Comes out of `check`; `lowering` is its only reader. Holds the syntax tree and, beside it, what the
checker found out about it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from dslkit.source import SourceFile
from rossmarie.check.effects import CheckedEffect
from rossmarie.ir.filing import Category, LeftOut
from rossmarie.ir.reactions import CommandTopic
from rossmarie.ir.script import Script
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
    `most` is the number of elements that lists of the message may have.
    """

    declaration: ast.Input
    topic: str
    message_type: str
    path: tuple[str, ...]
    type: Type
    timeout_ns: int | None
    most: int | None = None


@dataclass(frozen=True)
class CheckedFeedback:
    """The amounts that a learner loses by a rule, and the unit of its margin if it declares one."""

    per_activation: float
    per_second: float
    margin: Unit | None


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
    those of each rule, `left_out` what a selection does not hold. `message_files` are the
    definitions of messages that were read, those that come with this program left out.
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
    feedback: tuple[CheckedFeedback, ...] = ()
    categories: tuple[tuple[Category, ...], ...] = ()
    left_out: LeftOut | None = None
    message_files: tuple[SourceFile, ...] = ()
    tests: tuple[Script, ...] = ()
