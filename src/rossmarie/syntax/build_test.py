"""Build the statements of a test from the rules that the grammar recognises.

One method per rule of ross.lark, as in `build`, which describes their arguments and guarantees.
"""

from __future__ import annotations

from typing import Any

from rossmarie.syntax import ast
from rossmarie.syntax.build_effect import EffectBuilder
from rossmarie.syntax.build_expression import WordArgument
from rossmarie.syntax.scan import Token


class TestBuilder(EffectBuilder):
    """Builds the tests of one file."""

    def test(self, parts: list[Any]) -> ast.Test:
        """`test "NAME" { STATEMENT; ... }`."""
        statements = tuple(part for part in parts if isinstance(part, ast.Statement))
        documentation = self._source.documentation.get(parts[0].start)
        return ast.Test(self.text(parts[1:2]), statements, documentation, self._span(parts))

    def at_instant(self, parts: list[Any]) -> ast.Arrival | ast.OperatorReset:
        """`at INSTANT reset RULE`, `at INSTANT SETTING, ...`."""
        if isinstance(parts[2], WordArgument):
            return ast.OperatorReset(parts[1], parts[2].value, self._span(parts))
        return ast.Arrival(parts[1], None, None, _settings(parts), self._span(parts))

    def repeated(self, parts: list[Any]) -> ast.Arrival:
        """`every PERIOD from INSTANT to INSTANT SETTING, ...`."""
        stretch = _stretch(parts[2:])
        return ast.Arrival(None, parts[1], stretch, _settings(parts), self._span(parts))

    def expectation(self, parts: list[Any]) -> ast.Expectation | ast.CommandExpectation:
        """`expect RULE active at INSTANT`, `expect RULE inactive from INSTANT to INSTANT`,
        `expect TOPIC.WORD in RANGE at INSTANT`.
        """
        words = [part.text if isinstance(part, Token) else "" for part in parts]
        behind = 2
        while words[behind] == ".":
            behind += 2
        if words[behind] not in ("active", "inactive"):
            return self._command_expectation(parts, words.index("in", 2))
        at, stretch = _when(parts[behind + 1 :])
        is_active = words[behind] == "active"
        rule = self.qualified(parts[1:behind])
        return ast.Expectation(rule, is_active, at, stretch, self._span(parts))

    def _command_expectation(self, parts: list[Any], middle: int) -> ast.CommandExpectation:
        """A field may have any word as its name, including `in`."""
        while isinstance(parts[middle + 1], Token):
            middle += 1
        topic, path = self.name(parts[1]), self.field_path(parts[3:middle])
        at, stretch = _when(parts[middle + 2 :])
        found = parts[middle + 1], at, stretch, self._span(parts)
        return ast.CommandExpectation(topic, path, *found)

    def resetting(self, parts: list[Any]) -> WordArgument:
        """`reset`, `reset RULE`."""
        return WordArgument(
            "reset", self.name(parts[1]) if len(parts) > 1 else None, self._span(parts)
        )

    def setting(self, parts: list[Any]) -> ast.Setting:
        """`PATH = VALUE`, `PATH = unknown`, `PATH = []`, `PATH`."""
        value = parts[2] if len(parts) > 2 else None
        is_unknown = isinstance(value, WordArgument)
        return ast.Setting(parts[0], None if is_unknown else value, is_unknown, self._span(parts))

    def setting_path(self, parts: list[Any]) -> ast.SettingPath:
        """`INPUT.WORD[0]`, `INPUT.WORD[A .. B]`."""
        steps: list[ast.Name | ast.Position | ast.Arc] = []
        for part in parts:
            steps += [part] if isinstance(part, ast.Arc) else self.field_path([part]).steps
        return ast.SettingPath(tuple(steps), self._span(parts))

    def unknown(self, parts: list[Any]) -> WordArgument:
        """`unknown`."""
        return WordArgument("unknown", None, self._span(parts))

    def nothing(self, parts: list[Any]) -> ast.Bracket:
        """`[]`."""
        return ast.Bracket((), None, self._span(parts))


def _when(parts: list[Any]) -> tuple[ast.Expression | None, ast.Stretch | None]:
    """`at INSTANT`, `from INSTANT to INSTANT`."""
    is_at = parts[0].text == "at"
    return (parts[1], None) if is_at else (None, _stretch(parts))


def _stretch(parts: list[Any]) -> ast.Stretch:
    """`from INSTANT to INSTANT`."""
    return ast.Stretch(parts[1], parts[3], parts[2].text == "until")


def _settings(parts: list[Any]) -> tuple[ast.Setting | ast.Doing, ...]:
    return tuple(part for part in parts if isinstance(part, ast.Setting | ast.Doing))
