"""ross.lark at work: lark's LALR parser, fed one stretch of tokens.

Tokens come from `scan`. What a word is - keyword, name, field, unit, type, topic - is decided by
what the parser can take at that point. Values come from the methods of a builder, called bottom up.
"""

from __future__ import annotations

import hashlib
import io
import re
import sys
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import lark
from lark import Lark, Transformer, UnexpectedInput

from rossmarie.cache import kept
from rossmarie.syntax.scan import Scan, Token
from rossmarie.syntax.temporal import PREFIXES, is_operator
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
    "constant",
    "input",
    "entity",
    "rule",
    "priority",
    "hazard",
    "condition",
    "expression",
    "unless",
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


@dataclass(frozen=True)
class Grammar:
    """The parser, and its names for the literals of the grammar (`COLON` of `:`), both ways."""

    lark: Lark
    literals: Mapping[str, str]
    terminals: Mapping[str, str]

    def symbols(self, names: Iterable[str]) -> frozenset[str]:
        """The terminals among lark's names: a literal stands for itself, others behind a `$`."""
        return frozenset(self.literals.get(name, f"${name}") for name in names if name.isupper())

    def fitting(self, parser: Any) -> frozenset[str]:
        """The symbols that a parser may be able to take in its state; asked for every token."""
        state = parser.parser_state.position
        if state not in self._fitting:
            self._fitting[state] = self.symbols(parser.choices())
        return self._fitting[state]

    def accepted(self, parser: Any) -> frozenset[str]:
        """The symbols that a parser takes in its state, with what it has gone through."""
        stack = tuple(parser.parser_state.state_stack)
        if stack not in self._accepted:
            self._accepted[stack] = self.symbols(parser.accepts())
        return self._accepted[stack]

    @cached_property
    def _accepted(self) -> dict[tuple[int, ...], frozenset[str]]:
        return {}

    @cached_property
    def _fitting(self) -> dict[int, frozenset[str]]:
        return {}


@cache
def load_grammar() -> Grammar:
    """The parser of ross.lark; its tables are built once and kept in the user's cache folder.

    Raises lark's `GrammarError` if it is not LALR(1).
    """
    text = (Path(__file__).parent / "ross.lark").read_text(encoding="utf-8")
    loaded = Lark.load(io.BytesIO(kept(_name_of_tables(text), lambda: _tables(text))))
    literals = {term.name: str(term.pattern.value) for term in loaded.terminals}
    return Grammar(loaded, literals, {literal: name for name, literal in literals.items()})


def _name_of_tables(grammar: str) -> str:
    """Other tables have another name: those of another grammar, another lark, another Python."""
    makers = (grammar, *START_RULES, lark.__version__, sys.version)
    return f"{hashlib.sha256(repr(makers).encode()).hexdigest()[:32]}.tables"


def _tables(grammar: str) -> bytes:
    built = Lark(
        grammar,
        parser="lalr",
        start=list(START_RULES),
        keep_all_tokens=True,
        maybe_placeholders=False,
    )
    file = io.BytesIO()
    built.save(file)
    return file.getvalue()


class _Terminal(Token):
    """A token, and which terminal of the grammar it is in its place."""

    type: str


@dataclass(frozen=True)
class Failure:
    """Where parsing stopped: the token that does not fit, counted from the first of the stretch
    (its end if something is missing there).
    """

    index: int
    parser: Any  # lark's interactive parser, whose methods have no types

    @cached_property
    def expected(self) -> frozenset[str]:
        """The symbols of the grammar that would fit."""
        return load_grammar().symbols(self.parser.accepts())


class Recognizer:
    """Parses stretches of one file with one builder."""

    def __init__(self, source: Scan, builder: object) -> None:
        self._text = source.file.text
        self._tokens = source.tokens
        self._grammar = load_grammar()
        self._assemble = _Assemble(builder)

    def run(self, start: str, first: int, last: int, head: str | None = None) -> Any:
        """The value of the rule `start` for the tokens from `first` up to, not including, `last`;
        or the `Failure`. `head` stands in for the first token, if that one is misspelt.
        """
        parser: Any = self._grammar.lark.parse_interactive(start=start)
        index = first
        while index < last:
            symbol, token, after = self._classify(index, self._fitting(parser, index))
            if head is not None and index == first:
                symbol = head
            if not self._feed(parser, symbol, token):
                return Failure(index - first, parser)
            index = after
        if index > last:
            return Failure(last - first, parser)
        try:
            return self._assemble.transform(parser.feed_eof())
        except UnexpectedInput:
            return Failure(last - first, parser)

    def _fitting(self, parser: Any, index: int) -> Collection[str]:
        """The symbols that may fit here; a word that may be a name as well is looked at closely,
        as the parser's tables know of some words only that they fit somewhere else.
        """
        fitting = self._grammar.fitting(parser)
        text = self._tokens[index].text
        if text in fitting and text not in RESERVED and "$NAME" in fitting:
            return self._grammar.accepted(parser)
        return fitting

    def _feed(self, parser: Any, symbol: str, token: Token) -> bool:
        """Say whether the token fits as that symbol; the parser has then taken it."""
        terminal: Any = _Terminal(*token)
        terminal.type = self._grammar.terminals.get(symbol, symbol.removeprefix("$"))
        try:
            parser.feed_token(terminal)
        except UnexpectedInput:
            return False
        return True

    def _classify(self, index: int, fitting: Collection[str]) -> tuple[str, Token, int]:
        """The symbol of the token here, the token (several joined, in a unit or topic), and the
        next.
        """
        token = self._tokens[index]
        kind, text = token.kind, token.text
        is_name = text in PREFIXES and "$NAME" in fitting and not is_operator(self._tokens, index)
        if text in fitting and not is_name:
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
        """The unit, type or topic that begins with this token, to its end.

        Ends with a whole token: in `m^2.5` the number is not torn apart.
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


class _Assemble(Transformer[Any, Any]):
    """Calls the builder's method of each rule with the parts of that rule.

    Recurses along the tree, whose depth the limits on nesting bound before anything is fed.
    """

    def __init__(self, builder: object) -> None:
        super().__init__(visit_tokens=False)
        self._builder = builder

    def __default__(self, data: str, children: list[Any], _: object) -> Any:
        """The result of a rule; lark calls this for every node of its tree."""
        return getattr(self._builder, data)(children)
