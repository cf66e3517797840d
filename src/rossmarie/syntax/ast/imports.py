"""Imports, and the parameters of files, which get values from imports."""

from __future__ import annotations

import enum
from dataclasses import dataclass

from dslkit.source import Span
from rossmarie.syntax.ast.expressions import Expression, Name, Text, Unit


@dataclass(frozen=True)
class Given:
    """`braking = 1.2 m/s^2`, `scan = /front/scan`: the value of a parameter. A topic is a name; a
    name in a rules file, or a frame, is an expression.
    """

    name: Name
    value: Expression | Name
    span: Span


@dataclass(frozen=True)
class Import:
    """`import "separation.ross" with braking = 1.2 m/s^2, scan = /front/scan as front;` -- the path
    is relative to the importing file; `alias` is the name after `as`.
    """

    path: Text
    span: Span
    given: tuple[Given, ...] = ()
    alias: Name | None = None


class Meaning(enum.Enum):
    """The kind of a parameter's value. The enum value is its name in messages."""

    VALUE = "a value"
    TOPIC = "a topic"
    FRAME = "a frame"


@dataclass(frozen=True)
class Parameter:
    """`parameter braking = 1.2 m/s^2;`, `parameter gap in m;`, `parameter scan = topic /scan;` or
    `parameter base = frame base_link;`.

    `default` is a name for a topic or a frame. A number without a default has a `unit`. `tightens`
    is the word after `tightens` for a number that the running node may set, else None.
    """

    name: Name
    default: Expression | Name | None
    unit: Unit | None
    documentation: str | None
    span: Span
    tightens: Name | None = None
    meaning: Meaning = Meaning.VALUE
