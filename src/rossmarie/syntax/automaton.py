"""The LALR automaton: runs the tables of the grammar over a stretch of tokens.

Tokens come from `scan`. What a word is - keyword, name, field, unit, type, topic - is decided by
what the automaton can accept at that point. Values come from the methods of a builder, called
bottom up; nothing here recurses.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from rossmarie.syntax.scan import Scan, Token
from rossmarie.syntax.words import RESERVED

# The values on the stack are tokens, nodes of the tree and lists of both; which, the grammar says.
Reduction = tuple[int, str, Callable[[list[Any]], Any] | None]

_UNIT_PART = r"(?:[^\W\d_]|[%°])[\w%°]*(?:\^-?[0-9]+)?"
_CLASSES = {
    "$UNIT_NAME": re.compile(rf"{_UNIT_PART}(?:[.*/]{_UNIT_PART})*"),
    "$TYPE_NAME": re.compile(r"[A-Za-z][A-Za-z0-9_]*/(?:msg/)?[A-Za-z][A-Za-z0-9_]*"),
    "$TOPIC_NAME": re.compile(r"/[A-Za-z_][A-Za-z0-9_]*(?:/[A-Za-z0-9_]+)*"),
}
_COMPARISONS = frozenset(
    ("==", "!=", "<", "<=", ">", ">=", "=", "===", "!==", "<>", "=<", "=>", "≤", "≥", "≠")
)
_ALIASES = {"&&": "and", "&": "and", "||": "or", "|": "or", "!": "not"}


_REACH = 200  # states looked at to say what would fit; enough for any message


@dataclass(frozen=True)
class Tables:
    """What `generate` writes."""

    starts: dict[str, int]
    ends: dict[str, int]
    rules: list[tuple[str, int, str]]
    states: list[dict[str, int]]


@dataclass(frozen=True)
class Failure:
    """Where parsing stopped: the number of the token that does not fit (the end of the stretch if
    something is missing there) and the symbols of the grammar that would fit.
    """

    index: int
    expected: frozenset[str]


@cache
def load_tables() -> Tables:
    """The tables of the grammar; read once."""
    content = json.loads((Path(__file__).parent / "tables.json").read_text(encoding="utf-8"))
    starts, ends = (_merged(content[key]) for key in ("starts", "ends"))
    rules = [(name, length, action) for name, length, action in content["rules"]]
    return Tables(starts, ends, rules, content["states"])


def _merged(entries: list[dict[str, int]]) -> dict[str, int]:
    return {name: state for entry in entries for name, state in entry.items()}


class Automaton:
    """Parses stretches of one file with one builder."""

    def __init__(self, source: Scan, builder: object) -> None:
        self._text = source.file.text
        self._tokens = source.tokens
        self._tables = load_tables()
        self._reductions = [_reduction(rule, builder) for rule in self._tables.rules]

    def run(self, start: str, first: int, last: int, head: str | None = None) -> Any:
        """The value of the rule `start` for the tokens from `first` up to, not including, `last`;
        or the `Failure`. `head` stands in for the first token, if that one is misspelt.
        """
        rows = self._tables.states
        states = [self._tables.starts[start]]
        values: list[Any] = []
        index = first
        while index < last:
            row = rows[states[-1]]
            symbol, token, after = self._classify(index, row)
            if head is not None and index == first:
                symbol = head
            target = self._reduce_until_shift(states, values, symbol)
            if target is None:
                return Failure(index, self._expected(states))
            states.append(target)
            values.append(token)
            index = after
        if index > last or not self._reduce_to_end(states, values, self._tables.ends[start]):
            return Failure(last, self._expected(states))
        return values[-1]

    def _reduce_until_shift(self, states: list[int], values: list[Any], symbol: str) -> int | None:
        rows = self._tables.states
        while True:
            entry = rows[states[-1]].get(symbol)
            if entry is None or entry >= 0:
                return entry
            self._reduce(states, values, entry)

    def _reduce_to_end(self, states: list[int], values: list[Any], end: int) -> bool:
        rows = self._tables.states
        while states[-1] != end:
            entry = rows[states[-1]].get("$END")
            if entry is None or entry >= 0:
                return False
            self._reduce(states, values, entry)
        return True

    def _expected(self, states: list[int]) -> frozenset[str]:
        """The symbols that can be shifted next, perhaps after some reductions."""
        terminals = (symbol for symbol in self._tables.states[states[-1]] if _is_terminal(symbol))
        return frozenset(symbol for symbol in terminals if self._fits(states, symbol))

    def _fits(self, states: list[int], symbol: str) -> bool:
        rows = self._tables.states
        stack = states[-_REACH:]
        while True:
            entry = rows[stack[-1]].get(symbol)
            if entry is None or entry >= 0:
                return entry is not None
            length, result, _ = self._reductions[-1 - entry]
            if length >= len(stack):
                return True
            del stack[len(stack) - length :]
            stack.append(rows[stack[-1]][result])

    def _reduce(self, states: list[int], values: list[Any], entry: int) -> None:
        length, symbol, call = self._reductions[-1 - entry]
        if call is not None:
            parts = values[-length:] if length else []
            if length:
                del values[-length:]
                del states[-length:]
            values.append(call(parts))
        else:
            states.pop()
        states.append(self._tables.states[states[-1]][symbol])

    def _classify(self, index: int, row: dict[str, int]) -> tuple[str, Token, int]:
        """What the token is here, the token (several joined, in a unit or topic), and the next."""
        token = self._tokens[index]
        kind, text = token.kind, token.text
        if text in row:
            return text, token, index + 1
        if kind == "number":
            return "$NUMBER", token, index + 1
        if kind == "text":
            return "$TEXT", token, index + 1
        if kind == "word":
            return self._classify_word(index, token, row)
        if text in _COMPARISONS:
            return "$COMPARE", token, index + 1
        if text == "/" and "$TOPIC_NAME" in row:
            return self._join("$TOPIC_NAME", index)
        if text in "%°" and "$UNIT_NAME" in row:
            return self._join("$UNIT_NAME", index)
        return _ALIASES.get(text, text), token, index + 1

    def _classify_word(
        self, index: int, token: Token, row: dict[str, int]
    ) -> tuple[str, Token, int]:
        if "$WORD" in row and token.text.isascii():
            return "$WORD", token, index + 1
        if token.text in RESERVED:
            return token.text, token, index + 1
        if "$UNIT_NAME" in row:
            return self._join("$UNIT_NAME", index)
        if "$TYPE_NAME" in row:
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


def _is_terminal(symbol: str) -> bool:
    return not symbol.startswith("$") or symbol[1:].isupper()


def _reduction(rule: tuple[str, int, str], builder: object) -> Any:
    name, length, action = rule
    if action == "pass":
        return (length, f"${name}", None)
    if action == "list":
        return (length, f"${name}", _flatten)
    method = getattr(builder, action.removeprefix("call "))
    return (length, f"${name}", lambda parts: method(_flatten(parts)))


def _flatten(parts: Sequence[Any]) -> list[Any]:
    """One list of all parts; the first list is reused, so that long lists take linear time."""
    if parts and type(parts[0]) is list:
        flat: list[Any] = parts[0]
        parts = parts[1:]
    else:
        flat = []
    for part in parts:
        if type(part) is list:
            flat.extend(part)
        else:
            flat.append(part)
    return flat
