"""Characters that make a file look different from its content. Each is an error in any place.

Some editors end a line at a lone carriage return, a line separator or a form feed, and change the
writing direction at other characters. So a rule could seem to be active although it is part of a
comment.
"""

from __future__ import annotations

import re
import unicodedata
from bisect import bisect_right
from collections.abc import Iterator

from dslkit.diagnostics import Diagnostic, Edit, Fix
from dslkit.source import Span
from rossmarie.syntax import errors
from rossmarie.syntax.scan import ScannedFile, Token

_LONE_RETURN = re.compile(r"\r(?!\n)")
_BREAKS = "\v\f\x85\u2028\u2029"
_BIDIRECTIONAL = "\u202a-\u202e\u2066-\u2069"  # `scan` skips these
_HIDDEN = re.compile(rf"[{_BREAKS}{_BIDIRECTIONAL}]")
_NAMES = {"\v": "vertical tab", "\f": "form feed", "\x85": "next line"}


def hidden_characters(source: ScannedFile) -> Iterator[Diagnostic]:
    """A finding for each such character; one for all lone carriage returns of a file."""
    text = source.file.text
    returns = [Span(source.file, one.start(), one.end()) for one in _LONE_RETURN.finditer(text)]
    if returns:
        finding = errors.HiddenCharacter(
            character="a carriage return without a line feed (U+000D)",
            reason="some programs end a line here, others do not",
        )
        fix = Fix("write line feeds", tuple(Edit(span, "\n") for span in returns))
        yield finding.at(returns[0], help=finding.LineFeed(), fix=fix)
    hidden = [Span(source.file, one.start(), one.end()) for one in _HIDDEN.finditer(text)]
    pieces = sorted((*source.tokens, *source.trivia), key=_start) if hidden else []
    for span in hidden:
        before = bisect_right(pieces, span.start, key=_start) - 1
        yield _hidden(span, is_inside=before >= 0 and span.start < pieces[before].end)


def _hidden(span: Span, *, is_inside: bool) -> Diagnostic:
    """A finding. `is_inside` is True in a comment or string, False between words."""
    letter = span.text
    is_break = letter in _BREAKS
    name = _NAMES.get(letter) or unicodedata.name(letter).lower()
    finding = errors.HiddenCharacter(
        character=f"the character U+{ord(letter):04X} ({name})",
        reason="some programs end a line here, others do not"
        if is_break
        else "programs show the characters around this in another order",
    )
    replacement = "\n" if is_break and not is_inside else ""
    help = finding.Remove()
    return finding.at(span, help=help, fix=Fix(str(help), (Edit(span, replacement),)))


def _start(piece: Token) -> int:
    return piece.start
