"""The words `once`, `after`, `since`, `within` and `doing`: operators in some places, names
elsewhere.

`once` and `after` precede an operand, `since` and `within` come between two operands. Each is an
operator if an operand follows, else a name. `doing` is an operator if a name follows.
"""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie.syntax.scan import Token
from rossmarie.syntax.words import RESERVED

PREFIXES = frozenset({"once", "after"})
_BETWEEN = frozenset({"since", "within"})
_OPENING = frozenset({"not", "true", "false"})


def is_operator(tokens: Sequence[Token], index: int) -> bool:
    """Say whether `once` or `after` is an operator here: an operand has to follow."""
    behind = index + 1
    while behind < len(tokens) and tokens[behind].text in _BETWEEN:
        behind += 1
    # If words that may come between two operands follow each other, every second word is a name.
    is_even = (behind - index) % 2 == 1
    return is_even is (behind < len(tokens) and _opens(tokens[behind]))


def names_skill(tokens: Sequence[Token], index: int) -> bool:
    """Say whether `doing` is an operator here: the name of a skill has to follow."""
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
