"""Build system models from the rules that the grammar recognises.

One method per rule of ross.lark, as in `build`, which describes their arguments and guarantees.
"""

from __future__ import annotations

from typing import Any

from rossmarie.syntax import ast
from rossmarie.syntax.build_zone import ZoneBuilder
from rossmarie.syntax.scan import Token


class SystemBuilder(ZoneBuilder):
    """Builds the system models of one file."""

    def system(self, parts: list[Any]) -> ast.System:
        """`system NAME { ... }`."""
        members = tuple(part for part in parts if not isinstance(part, Token))
        documentation = self._documentation(parts)
        return ast.System(self.name(parts[1]), members, documentation, self._span(parts))

    def topic_declaration(self, parts: list[Any]) -> ast.TopicDeclaration:
        """`topic ALIAS = TOPIC : TYPE in UNIT at RATE`."""
        has_alias = is_token(parts, 2, "=")
        alias = self.name(parts[1]) if has_alias else None
        rest = parts[3 if has_alias else 1 :]
        unit = self._unit(rest[4]) if is_token(rest, 3, "in") else None
        rate = rest[-1] if is_token(rest, -2, "at") else None
        place = 3 if unit is None else 5
        source = self._frame(rest[place + 1]) if is_token(rest, place, "from") else None
        topic, message_type, span = self.name(rest[0]), self._type(rest[2]), self._span(parts)
        return ast.TopicDeclaration(alias, topic, message_type, unit, rate, span, source)

    def frame_declaration(self, parts: list[Any]) -> ast.FrameDeclaration:
        """`frame NAME = FRAME in FRAME at PLACE turned ANGLES timeout DURATION`."""
        has_alias = is_token(parts, 2, "=")
        alias = self.name(parts[1]) if has_alias else None
        frame, _, parent, *behind = parts[3 if has_alias else 1 :]
        reported = {word.text: value for word, value in zip(behind[::2], behind[1::2], strict=True)}
        return ast.FrameDeclaration(
            alias, self._frame(frame), self._frame(parent),
            reported.get("at"), reported.get("turned"), reported.get("timeout"), self._span(parts),
        )  # fmt: skip

    def service_declaration(self, parts: list[Any]) -> ast.ServiceDeclaration:
        """`service SERVICE : TYPE`."""
        name, kind = self.name(parts[1]), self._type(parts[3])
        return ast.ServiceDeclaration(name, kind, self._span(parts))

    def server_declaration(self, parts: list[Any]) -> ast.ServerDeclaration:
        """`server SERVER : TYPE`."""
        name, kind = self.name(parts[1]), self._type(parts[3])
        return ast.ServerDeclaration(name, kind, self._span(parts))

    def resource_declaration(self, parts: list[Any]) -> ast.ResourceDeclaration:
        """`resource NAME : TARGET, TARGET`."""
        targets = tuple(map(self.name, parts[3::2]))
        return ast.ResourceDeclaration(self.name(parts[1]), targets, self._span(parts))

    def unit_declaration(self, parts: list[Any]) -> ast.UnitDeclaration:
        """`unit TYPE.path = UNIT`."""
        path, index = self._path(parts, 2)
        unit = self._unit(parts[index + 1])
        return ast.UnitDeclaration(self._type(parts[1]), path, unit, self._span(parts))

    def messages_declaration(self, parts: list[Any]) -> ast.MessagesDeclaration:
        """`messages "folder"`."""
        return ast.MessagesDeclaration(self.text([parts[1]]), self._span(parts))

    def node(self, parts: list[Any]) -> ast.NodeDeclaration:
        """`node NAME { publishes TOPIC, ...; subscribes TOPIC, ...; }`."""
        topics = self._listed(parts[3:-1], ("publishes", "subscribes"))
        publishes, subscribes = topics["publishes"], topics["subscribes"]
        return ast.NodeDeclaration(self.name(parts[1]), publishes, subscribes, self._span(parts))

    # --- parts -----------------------------------------------------------------------------------

    def _documentation(self, parts: list[Any]) -> str | None:
        return self._source.documentation.get(parts[0].start)

    def _frame(self, token: Token) -> ast.Name:
        """A frame, given by its bare name or in quotes."""
        text = token.text[1:-1] if token.kind == "text" else token.text
        return ast.Name(text, self._at(token))


def is_token(parts: list[Any], index: int, text: str) -> bool:
    """Say whether a token with this text is at this index."""
    return index < len(parts) and isinstance(parts[index], Token) and parts[index].text == text
