"""Build zones: shapes in the plane of a frame."""

from __future__ import annotations

from typing import Any

from rossmarie.syntax import ast
from rossmarie.syntax.build_test import TestBuilder
from rossmarie.syntax.scan import Token


class ZoneBuilder(TestBuilder):
    """Builds zones, and the parts of tests."""

    def zone(self, parts: list[Any]) -> ast.Zone:
        """`zone NAME in FRAME { SHAPE; ... }`."""
        name, frame = self.name(parts[1]), self.frame(parts[3])
        documentation = self._source.documentation.get(parts[0].start)
        shapes = tuple(part for part in parts if isinstance(part, ast.Shape))
        return ast.Zone(name, frame, shapes, documentation, self._span(parts))

    def frame(self, token: Token) -> ast.Name:
        """The name of a frame, `base_link` or `"robot1/base_link"`."""
        if token.kind != "text":
            return self.name(token)
        text = self.text([token])
        return ast.Name(text.value, text.span)

    def shape(self, parts: list[Any]) -> ast.Shape:
        """`box [...] m`, `circle [...] m radius 0.4 m` or `polygon [...], [...], [...] m`."""
        brackets = tuple(part for part in parts if isinstance(part, ast.Bracket))
        radius = parts[-1] if not isinstance(parts[-1], ast.Bracket) else None
        return ast.Shape(self.name(parts[0]), brackets, radius, self._span(parts))
