"""Limits of parsing, which keep every later pass within Python's recursion limit.

A pass may use up to three frames per level: 250 levels fit into the default limit of 1000.
"""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie.syntax.scan import Token
from rossmarie.syntax.temporal import PREFIXES, is_operator
from rossmarie.syntax.words import FOREIGN, OPERATOR_WORDS

MAXIMUM_FILE_SIZE = 2**20
"""The most bytes of UTF-8 in one file."""

MAXIMUM_TOKENS = 300_000
"""The most words and signs in one file. Ordinary text reaches the limit in bytes before this
limit.
"""

MAXIMUM_NESTING = 64
"""The most levels of brackets, prefix operators, and `once` and `after` up to their `within`,
inside each other.
"""

MAXIMUM_DEPTH = 250
"""The most levels of an expression. Each operator of `a + b + c` is one level."""

MAXIMUM_LENGTH = 10_000
"""The most tokens of one constant, input, condition or rule."""

MAXIMUM_ERRORS = 100
"""The most errors, and the most warnings, that are reported for one file. Then reading stops."""

_CLOSING = frozenset(")]")
_RESTART = frozenset(";{}:")


def too_deep(tokens: Sequence[Token], first: int, last: int) -> int | None:
    """The index of the token that exceeds the nesting limit, if there is one."""
    levels: list[tuple[str, int]] = []
    level = 0
    prefixes = 0
    for index in range(first, last):
        text = tokens[index].text
        if text in ("(", "[") or (text in PREFIXES and is_operator(tokens, index)):
            levels.append((text, 1 + prefixes))
            level += 1 + prefixes
            prefixes = 0
        elif text in _CLOSING or (text == "within" and levels and levels[-1][0] in PREFIXES):
            level -= _closed(levels, text)
            prefixes = 0
        elif FOREIGN.get(text, text) == "not" or (text == "-" and is_prefix(tokens, index, first)):
            prefixes += 1
        else:
            prefixes = 0
            if text in _RESTART:
                levels.clear()
                level = 0
        if level + prefixes > MAXIMUM_NESTING:
            return index
    return None


def _closed(levels: list[tuple[str, int]], text: str) -> int:
    """The number of levels that end with a bracket or a `within`. A bracket also ends the levels
    inside it.
    """
    closed = 0
    while levels:
        opening, count = levels.pop()
        closed += count
        if text == "within" or opening not in PREFIXES:
            break
    return closed


def is_prefix(tokens: Sequence[Token], index: int, first: int) -> bool:
    """Say whether a `-` at this place has no value to its left."""
    return index == first or not ends_value(tokens[index - 1])


def ends_value(token: Token) -> bool:
    """Say whether a value can end with this token."""
    if token.kind == "sign":
        return token.text in (")", "]", "%", "°")
    return token.text not in OPERATOR_WORDS and token.text not in ("if", "then")
