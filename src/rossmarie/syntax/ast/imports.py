"""Imports, and the parameters of files that they give values to."""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.source import Span
from rossmarie.syntax.ast.expressions import Expression, Name, Text, Unit


@dataclass(frozen=True)
class Given:
    """`braking = 1.2 m/s^2`, `scan = /front/scan`: a value, or a topic, for a parameter."""

    name: Name
    value: Expression | Name
    span: Span


@dataclass(frozen=True)
class Import:
    """`import "separation.ross" with braking = 1.2 m/s^2, scan = /front/scan as front;` -- the path
    is relative to the importing file; `alias` is the name behind `as`.
    """

    path: Text
    span: Span
    given: tuple[Given, ...] = ()
    alias: Name | None = None


@dataclass(frozen=True)
class Parameter:
    """`parameter braking = 1.2 m/s^2;`, `parameter gap in m;` or `parameter scan = topic /scan;`.

    `default` is a topic if it is a name; without one there is a `unit`. `tightens` is the word
    behind `tightens` of a number that the running node may set, None if it may not.
    """

    name: Name
    default: Expression | Name | None
    unit: Unit | None
    documentation: str | None
    span: Span
    tightens: Name | None = None
