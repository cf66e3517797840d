"""Tests: messages with their instants, and expectations about the rules."""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.source import Span
from rossmarie.syntax.ast.effects import FieldPath, Position
from rossmarie.syntax.ast.expressions import Arc, Doing, Expression, Name, Text


@dataclass(frozen=True)
class Stretch:
    """`from 1 sec to 5 sec`. `from 1 sec until 5 sec` excludes the last instant."""

    first: Expression
    last: Expression
    is_open: bool


@dataclass(frozen=True)
class SettingPath:
    """`ranges[3]`, `joints["elbow"].effort`, `scan.ranges[-30 deg .. 30 deg]`; the first step is
    the name of an input.
    """

    steps: tuple[Name | Position | Arc, ...]
    span: Span


@dataclass(frozen=True)
class Setting:
    """`orientation.pitch = 12 deg`; `speed = unknown`; a bare `speed` repeats the last value."""

    path: SettingPath
    value: Expression | None
    is_unknown: bool
    span: Span


@dataclass(frozen=True)
class Arrival:
    """`at 1 sec speed = 0.3 m/s, doing Push` and `every 0.1 sec from 0 sec to 5 sec speed`.

    `at` is None if messages are repeated with a `period` over a `stretch`.
    """

    at: Expression | None
    period: Expression | None
    stretch: Stretch | None
    settings: tuple[Setting | Doing, ...]
    span: Span


@dataclass(frozen=True)
class OperatorReset:
    """`at 9 sec reset`, `at 9 sec reset emergency_stop`."""

    at: Expression
    rule: Name | None
    span: Span


@dataclass(frozen=True)
class Expectation:
    """`expect slow_on_bump active at 1.5 sec`, or over a `stretch`. Either the instant or the
    stretch is None.
    """

    rule: Name
    is_active: bool
    at: Expression | None
    stretch: Stretch | None
    span: Span


@dataclass(frozen=True)
class CommandExpectation:
    """`expect /cmd_vel.linear.x in [-0.2, 0.2] m/s at 2 sec`, or over a `stretch`. Either the
    instant or the stretch is None.
    """

    topic: Name
    path: FieldPath
    range: Expression
    at: Expression | None
    stretch: Stretch | None
    span: Span


Statement = Arrival | OperatorReset | Expectation | CommandExpectation


@dataclass(frozen=True)
class Test:
    """`test "bump slows down" { STATEMENT; ... }`."""

    name: Text
    statements: tuple[Statement, ...]
    documentation: str | None
    span: Span
