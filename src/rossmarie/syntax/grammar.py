"""The parser for ross.lark: an LALR parser that reads one range of tokens.

Tokens come from `scan`. The parser state decides the kind of a word: keyword, name, field, unit,
type or topic. The methods of a builder, called bottom up, create the values.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Collection
from dataclasses import dataclass
from functools import cache, cached_property, partial
from pathlib import Path
from typing import Any

from rossmarie.cache import kept
from rossmarie.syntax import tables
from rossmarie.syntax.scan import ScannedFile, Token
from rossmarie.syntax.tables import GrammarNode, Parser, Tables, make_tables, read_tables
from rossmarie.syntax.temporal import PREFIXES, is_operator, names_skill
from rossmarie.syntax.words import (
    COMPARISONS,
    EFFECT_WORDS,
    FOREIGN,
    OPERATOR_WORDS,
    RESERVED,
    STATEMENT_WORDS,
)

START_RULES = (
    "import_item",
    "system",
    "action",
    "skills",
    "parameter",
    "constant",
    "input",
    "entity",
    "motion",
    "part",
    "zone",
    "shape",
    "rule",
    "priority",
    "hazard",
    "condition",
    "expression",
    "scope",
    "unless",
    "exemption",
    "keeps",
    "category",
    "task",
    "feedback",
    "mitigates",
    "contract",
    "step",
    "topic_declaration",
    "service_declaration",
    "server_declaration",
    "resource_declaration",
    "unit_declaration",
    "messages_declaration",
    "frame_declaration",
    "node",
    "test",
    *STATEMENT_WORDS.values(),
    *EFFECT_WORDS.values(),
)
_UNIT_PART = r"(?:[^\W\d_]|[%°])[\w%°]*(?:\^-?[0-9]+)?"
_CLASSES = {
    "$UNIT_NAME": re.compile(rf"{_UNIT_PART}(?:[.*/]{_UNIT_PART})*"),
    "$TYPE_NAME": re.compile(
        r"[A-Za-z][A-Za-z0-9_]*/(?:(?:msg|srv|action)/)?[A-Za-z][A-Za-z0-9_]*"
    ),
    "$TOPIC_NAME": re.compile(r"/[A-Za-z_][A-Za-z0-9_]*(?:/[A-Za-z0-9_]+)*"),
}
_COMPARISONS = COMPARISONS | {sign for sign, meant in FOREIGN.items() if meant in COMPARISONS}
_LOGIC = {sign: meant for sign, meant in FOREIGN.items() if meant in OPERATOR_WORDS}


@cache
def load_tables() -> Tables:
    """The tables of ross.lark. They are computed once and stored in the user's cache folder.

    Raises lark's `GrammarError` if the grammar is not LALR(1).
    """
    text = (Path(__file__).parent / "ross.lark").read_text(encoding="utf-8")
    return read_tables(kept(_name_of_tables(text), partial(make_tables, text, START_RULES)))


def _name_of_tables(grammar: str) -> str:
    """The name of the tables. Tables of another grammar, or computed in another way, have another
    name.
    """
    made_by = Path(tables.__file__).read_text(encoding="utf-8")
    makers = (grammar, *START_RULES, made_by)
    return f"{hashlib.sha256(repr(makers).encode()).hexdigest()[:32]}.tables"


@dataclass(frozen=True)
class ParseFailure:
    """The place at which parsing stopped: the index of the token that does not fit, relative to the
    start of the range. It is the end of the range if a token is missing there.
    """

    index: int
    parser: Parser

    @cached_property
    def expected(self) -> frozenset[str]:
        """The symbols of the grammar that would fit."""
        return self.parser.tables.accepted(self.parser.stack)


class Recognizer:
    """Parses stretches of one file with one builder."""

    def __init__(self, source: ScannedFile, builder: object) -> None:
        self._text = source.file.text
        self._tokens = source.tokens
        self._tables = load_tables()
        self._builder = builder

    def run(self, start: str, first: int, last: int, head: str | None = None) -> Any:
        """The value of the rule `start` for the tokens from `first` up to, not including, `last`;
        or the `ParseFailure`. `head` replaces the first token if this token is misspelt.
        """
        parser = Parser(self._tables, self._tables.starts[start][:1])
        index = first
        while index < last:
            symbol, token, after = self._classify(index, self._fitting(parser, index))
            if head is not None and index == first:
                symbol = head
            if not parser.feed(symbol, token):
                return ParseFailure(index - first, parser)
            index = after
        if index > last:
            return ParseFailure(last - first, parser)
        found = parser.end()
        return ParseFailure(last - first, parser) if found is None else self._built(found[0])

    def _built(self, part: Any) -> Any:
        """The value of a node, from the builder's method for its rule; a token is its own value.

        Recurses along the nodes. The limits on nesting bound their depth before any token is read.
        """
        if isinstance(part, GrammarNode):
            return getattr(self._builder, part.rule)([self._built(each) for each in part.parts])
        return part

    def _fitting(self, parser: Parser, index: int) -> Collection[str]:
        """The symbols that may fit here. For a word that may also be a name, the exact set is
        computed, because the tables only state that some words fit somewhere.
        """
        fitting = parser.fitting
        text = self._tokens[index].text
        if text in fitting and text not in RESERVED and "$NAME" in fitting:
            return self._tables.accepted(parser.stack)
        return fitting

    def _classify(self, index: int, fitting: Collection[str]) -> tuple[str, Token, int]:
        """The symbol of the current token, the token itself (for a unit or topic, several joined
        tokens), and the next index.
        """
        token = self._tokens[index]
        kind, text = token.kind, token.text
        if text in fitting and not ("$NAME" in fitting and self._is_name(index)):
            return text, token, index + 1
        if kind == "number":
            return "$NUMBER", token, index + 1
        if kind == "text":
            return "$TEXT", token, index + 1
        if kind == "word":
            return self._classify_word(index, token, fitting)
        if text in _COMPARISONS:
            return "$COMPARE", token, index + 1
        if text == "/" and "$TOPIC_NAME" in fitting:
            return self._join("$TOPIC_NAME", index)
        if text in "%°" and "$UNIT_NAME" in fitting:
            return self._join("$UNIT_NAME", index)
        return _LOGIC.get(text, text), token, index + 1

    def _is_name(self, index: int) -> bool:
        """Say whether a word that may be an operator here is a name."""
        text = self._tokens[index].text
        if text in ("doing", "ahead"):
            return not names_skill(self._tokens, index)
        return text in PREFIXES and not is_operator(self._tokens, index)

    def _classify_word(
        self, index: int, token: Token, fitting: Collection[str]
    ) -> tuple[str, Token, int]:
        if "$WORD" in fitting and token.text.isascii():
            return "$WORD", token, index + 1
        if token.text in RESERVED:
            return token.text, token, index + 1
        if "$UNIT_NAME" in fitting:
            return self._join("$UNIT_NAME", index)
        if "$TYPE_NAME" in fitting:
            return self._join("$TYPE_NAME", index)
        return ("$NAME" if token.text.isascii() else token.text), token, index + 1

    def _join(self, symbol: str, index: int) -> tuple[str, Token, int]:
        """The whole unit, type or topic that begins with this token.

        It ends with a whole token: in `m^2.5` the number is not split.
        """
        first = self._tokens[index]
        match = _CLASSES[symbol].match(self._text, first.start)
        if match is None:
            return first.text, first, index + 1
        end = match.end()
        after = index + 1
        while after < len(self._tokens) and self._tokens[after].start < end:
            after += 1
        end = max(end, self._tokens[after - 1].end)
        return symbol, Token("word", self._text[first.start : end], first.start, end), after
