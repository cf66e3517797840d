"""Zones: shapes in the plane of a frame."""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.source import Span
from rossmarie.syntax.ast.expressions import Bracket, Expression, Name


@dataclass(frozen=True)
class Shape:
    """`box [0.2, 0.9, -0.4, 0.4] m`, `circle [0.9, 0] m radius 0.4 m` or `polygon [0, 1], [1, 1],
    [1, 2] m`; `word` is the first word, `radius` the radius of a circle.
    """

    word: Name
    brackets: tuple[Bracket, ...]
    radius: Expression | None
    span: Span


@dataclass(frozen=True)
class Zone:
    """`zone stopZone in base_link { ... }`: some shapes in the x-y plane of a frame."""

    name: Name
    frame: Name
    shapes: tuple[Shape, ...]
    documentation: str | None
    span: Span
