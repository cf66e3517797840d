"""The words `once`, `after`, `since`, `within` and `doing`: operators in their places, and names
elsewhere.

`once` and `after` stand before an operand, `since` and `within` between two: each is an operator if
an operand follows it, and the name of something if not. `doing` is one if a name follows it.
"""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie.syntax.scan import Token
from rossmarie.syntax.words import RESERVED

PREFIXES = frozenset({"once", "after"})
_BETWEEN = frozenset({"since", "within"})
_OPENING = frozenset({"not", "true", "false"})


def is_operator(tokens: Sequence[Token], index: int) -> bool:
    """Say whether `once` or `after` is an operator here: whether an operand begins behind it."""
    behind = index + 1
    while behind < len(tokens) and tokens[behind].text in _BETWEEN:
        behind += 1
    # Of words that may stand between two operands, every other one is a name.
    is_even = (behind - index) % 2 == 1
    return is_even is (behind < len(tokens) and _opens(tokens[behind]))


def names_skill(tokens: Sequence[Token], index: int) -> bool:
    """Say whether `doing` is an operator here: whether the name of a skill stands behind it."""
    behind = index + 1
    if behind == len(tokens) or tokens[behind].kind != "word" or tokens[behind].text in RESERVED:
        return False
    is_between = tokens[behind].text in _BETWEEN and behind + 1 < len(tokens)
    return not (is_between and _opens(tokens[behind + 1]))


def _opens(token: Token) -> bool:
    """Say whether a value begins with this token."""
    match token.kind:
        case "number" | "text" | "open_text":
            return True
        case "word":
            return token.text not in RESERVED or token.text in _OPENING
        case _:  # open: signs
            return token.text in ("(", "!")
