"""Cuts text into words, signs, comments and documentation, in one linear pass.

Any text is accepted. `grammar` decides the meaning of words (keyword, name, unit), which depends on
their place. A comment `/* ... */` is separated like any other, and `parse` reports it. A `'''` that
is never closed ends before the next line that begins an item, so that it does not hide the rest of
the file. A carriage return ends a line, so that it hides nothing in a comment; `hidden` reports it
unless a line feed follows.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from dslkit.source import SourceFile, Span
from rossmarie.syntax.words import ITEM_WORDS

_TOKEN = re.compile(
    r"""
      (?P<comment>//[^\r\n]*)
    | (?P<hash_comment>[#][^\r\n]*)
    | (?P<block_comment>/\*)
    | (?P<documentation>'''.*?''')
    | (?P<quoted_documentation>"{3}.*?"{3})
    | (?P<text>"[^"\r\n]*")
    | (?P<open_documentation>''')
    | (?P<open_text>"[^\r\n]*)
    | (?P<word>[^\W\d]\w*)
    | (?P<number>
        (?:
            (?<!\.)[0-9]+\.(?![0-9.])      # a digit is missing behind the point ...
          | [0-9]+(?:\.[0-9]+)?
          | (?<![\w.)\]])\.[0-9]+         # ... or in front of it: `respell` says so
        )
        (?:[eE][+-]?[0-9]+)?
      )
    | (?P<sign>\.\.|===|!==|==|!=|<=|>=|=<|=>|<>|&&|\|\||->|[^\s\ufeff\u202a-\u202e\u2066-\u2069])
    """,
    re.DOTALL | re.VERBOSE,
)
_ITEM_LINE = re.compile(rf"(?<![^\r\n])[ \t]*(?:{'|'.join(ITEM_WORDS)})\b")
_LINE_END = re.compile(r"[\r\n]|\Z")
_TRIVIA = frozenset(
    {"comment", "hash_comment", "block_comment", "documentation", "quoted_documentation"}
    | {"open_documentation"}
)


class Token(NamedTuple):
    """A piece of text: `kind` is `word`, `number`, `sign`, `text` (in quotes), `open_text` (the
    closing quote is missing), `comment`, `documentation`, or one of these mistakes: `hash_comment`,
    `block_comment`, `quoted_documentation` and `open_documentation`.
    """

    kind: str
    text: str
    start: int
    end: int


@dataclass(frozen=True)
class ScannedFile:
    """A file in pieces: `tokens` carry meaning, `trivia` are comments and documentation strings."""

    file: SourceFile
    tokens: tuple[Token, ...]
    trivia: tuple[Token, ...]
    reported: frozenset[int] = frozenset()
    """The starts of tokens that cannot be parsed and are already reported."""

    @cached_property
    def documentation(self) -> dict[int, str]:
        """The documentation string directly before each token, by the start of the token."""
        found: dict[int, str] = {}
        index = 0
        for trivium in self.trivia:
            if trivium.kind in ("documentation", "quoted_documentation"):
                while index < len(self.tokens) and self.tokens[index].start < trivium.end:
                    index += 1
                if index < len(self.tokens):
                    found[self.tokens[index].start] = documentation_text(trivium.text)
        return found

    def span(self, first: Token, last: Token | None = None) -> Span:
        """The span from the start of one token to the end of another, or of the same token."""
        return Span(self.file, first.start, (last or first).end)

    def begins_line(self, index: int) -> bool:
        """Say whether a token is the first on its line."""
        before = self.tokens[index - 1].end if index else 0
        return index == 0 or ends_line(self.file.text[before : self.tokens[index].start])


def scan(file: SourceFile) -> ScannedFile:
    """Cut a text into tokens."""
    found = list(_find(file.text))
    tokens = tuple(token for token in found if token.kind not in _TRIVIA)
    trivia = tuple(token for token in found if token.kind in _TRIVIA)
    return ScannedFile(file, tokens, trivia)


def ends_line(text: str) -> bool:
    """Say whether a text between two tokens contains the end of a line."""
    return "\n" in text or "\r" in text


def tokens_of(text: str) -> tuple[Token, ...]:
    """The tokens of a text, without comments and documentation."""
    return tuple(token for token in _find(text) if token.kind not in _TRIVIA)


def documentation_text(literal: str) -> str:
    """The content of a documentation string: without quotes, common indentation, trailing space."""
    lines = inspect.cleandoc(literal[3:-3]).splitlines()
    return "\n".join(line.rstrip() for line in lines).strip()


def _find(text: str) -> Iterator[Token]:
    found = list(_tokens(text, 0))
    unclosed = next((token for token in found if token.kind == "open_documentation"), None)
    if unclosed is None:
        yield from found
        return
    # One ''' is missing, not necessarily the last one: more likely it is missing before an item
    # than inside an item.
    for token in found:
        if token is unclosed or _swallows_item(token):
            end = _end_of_unclosed(text, token.start)
            yield Token("open_documentation", text[token.start : end], token.start, end)
            yield from _tokens(text, end)
            return
        yield token


def _tokens(text: str, position: int) -> Iterator[Token]:
    last_closing = text.rfind("*/")
    while match := _TOKEN.search(text, position):
        kind, start, position = match.lastgroup or "", match.start(), match.end()
        if kind == "block_comment":
            position = _end_of_block(text, position, last_closing)
        yield Token(kind, text[start:position], start, position)


def _end_of_block(text: str, position: int, last_closing: int) -> int:
    """The end of a comment `/* ... */` that began before `position`; an unclosed comment is one
    line.
    """
    if position <= last_closing:
        return text.index("*/", position) + len("*/")
    end = _LINE_END.search(text, position)
    return end.start() if end else len(text)


def _swallows_item(token: Token) -> bool:
    return token.kind == "documentation" and _ITEM_LINE.search(token.text, 3) is not None


def _end_of_unclosed(text: str, start: int) -> int:
    following = _ITEM_LINE.search(text, start + 3)
    end = following.start() if following else len(text)
    return len(text[:end].rstrip())
