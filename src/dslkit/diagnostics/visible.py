"""The appearance of source text on a terminal: the width of its characters, and no raw control
characters.

A character that could move the cursor, change colours or the writing direction, or that is
invisible, is replaced by a visible one.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator

_TAB_STOP = 4
_HIDDEN = frozenset({"Cc", "Cf", "Cn", "Cs", "Zl", "Zp"})
_COMBINING = frozenset({"Mn", "Me"})


def visible(text: str) -> str:
    """`text` without characters that a terminal would act on or not show."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(_visible_character(character) for character in text)


def cells(text: str) -> int:
    """Count the columns of a terminal that `text`, already made visible, takes."""
    if text.isascii():
        return len(text)
    return sum(_width(character) for character in text)


def columns_of(line: str) -> Iterator[tuple[str, int]]:
    """Yield each character of a source line as it is shown, with its column from 0.

    Tabs become spaces up to the next stop.
    """
    column = 0
    for character in line:
        if " " <= character <= "~":
            yield character, column
            column += 1
            continue
        if character == "\t":
            shown = " " * (_TAB_STOP - column % _TAB_STOP)
        else:
            shown = _visible_character(character)
        yield shown, column
        column += cells(shown)


def _visible_character(character: str) -> str:
    if " " <= character <= "~":
        return character
    if unicodedata.category(character) not in _HIDDEN:
        return character
    number = ord(character)
    if number < 0x20:
        return chr(0x2400 + number)
    return f"<U+{number:04X}>"


def _width(character: str) -> int:
    if unicodedata.category(character) in _COMBINING:
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1
