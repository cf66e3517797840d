"""Cuts tokens into ranges of one item each, so that an error costs only its own item.

An item ends at a `;` outside braces, at the `}` of an entity, system or action (which `latched
until reset` may follow), or at an item word at the start of a line, however many braces are open.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from rossmarie.syntax.limits import ends_value
from rossmarie.syntax.scan import ScannedFile
from rossmarie.syntax.words import (
    CONTEXTUAL_ITEM_WORDS,
    ITEM_WORDS,
    MEANT,
    MEMBER_WORDS,
    OPERATOR_WORDS,
    RESERVED,
    nearest,
)

_NEVER_LAST = RESERVED - {"true", "false"}
_CONTINUATIONS = frozenset(
    {"when", "until", "timeout", "then", "clear", "latched", "unless", "while", "always"}
    | {"keeps", "category", "task", "feedback", "mitigates", "with", "as", "tightens"}
)
_CONTINUED = frozenset({"rule", "input", "import_item", "parameter"})
_JOINING = frozenset({"of", "within", "over"})  # a line break may precede or follow these
_LATCH = frozenset({"latched", "until", "reset"})
_BEHIND_NAME = frozenset({";", ":", "=", ".", "["})
_BEHIND_NAME_OF = {"motion": ("{",), "zone": ("in", "{"), "parameter": ("=", "in")}
# An unknown word before these words does not declare a name, unlike `entitty` in `entitty imu`:
# after a name, these words continue an item, or begin another part.
_NEVER_DECLARED = OPERATOR_WORDS | _CONTINUATIONS | ITEM_WORDS.keys()


class TokenRange(NamedTuple):
    """The tokens from `first` up to, not including, `last`.

    `kind` is the start rule of the grammar; None if no item begins like this. `head` is the correct
    word if the first word is misspelt.
    """

    kind: str | None
    first: int
    last: int
    head: str | None


def cut(source: ScannedFile) -> Iterator[TokenRange]:
    """All items of a file, in order; semicolons between items are dropped."""
    cutter = _Cutter(source)
    index = 0
    while index < len(source.tokens):
        if source.tokens[index].text == ";":
            index += 1
            continue
        piece = cutter.piece(index)
        yield piece
        index = piece.last


class _Cutter:
    def __init__(self, source: ScannedFile) -> None:
        self._source = source
        self._tokens = source.tokens

    def piece(self, first: int) -> TokenRange:
        word = self._tokens[first].text
        is_item = word in ITEM_WORDS or word in CONTEXTUAL_ITEM_WORDS
        head = None if is_item else self._meant(first)
        kind = ITEM_WORDS.get(head or word) or CONTEXTUAL_ITEM_WORDS.get(word)
        return TokenRange(kind, first, self._end(first, kind, head or word), head)

    def _end(self, first: int, kind: str | None, word: str) -> int:
        if self._tokens[first].text == "}":
            return first + 1
        depth = int(self._brace_is_missing(first, kind))
        awaits_if = word in ("rule", "always")
        for index in range(first + 1, len(self._tokens)):
            text = self._tokens[index].text
            if text == "if" and awaits_if:
                awaits_if = False
                continue
            awaits_if = awaits_if and text not in ("then", "{")
            if self._begins_item(index, depth) or (text == ";" and depth == 0):
                return index
            if depth == 0 and self._begins_unknown(first, index, kind):
                return index
            if text == "{":
                depth += 1
            elif text == "}":
                depth -= 1
                if depth < 0:
                    return index
                if depth == 0 and kind != "rule":
                    return self._behind_latch(index + 1) if kind == "action" else index + 1
        return len(self._tokens)

    def _behind_latch(self, index: int) -> int:
        while self._text(index) in _LATCH:
            index += 1
        return index

    def _brace_is_missing(self, first: int, kind: str | None) -> bool:
        """Say whether an entity, motion or system is written as `entity NAME CONDITION : ...`."""
        behind = first + 2
        if kind in ("entity", "motion"):
            return self._text(behind) != "{" and self._text(behind + 1) == ":"
        return kind == "system" and self._text(behind) in MEMBER_WORDS

    def _begins_item(self, index: int, depth: int) -> bool:
        token = self._tokens[index]
        before = self._tokens[index - 1]
        if token.text == "hazard":
            return self._is_word(index + 1) and self._is_kind(index + 2, "text")
        if token.text in _BEHIND_NAME_OF:
            is_named = self._is_word(index + 1)
            return is_named and self._text(index + 2) in _BEHIND_NAME_OF[token.text]
        if token.text == "always":
            return self._text(index + 1) == "if" and before.text != ":"
        if token.text in CONTEXTUAL_ITEM_WORDS:
            if token.text in ("test", "skills"):
                is_apart = depth == 0 or self._source.begins_line(index)
                return is_apart and self._is_kind(index + 1, "text")
            return self._is_word(index + 1) and self._text(self._behind_name(index + 1)) == "over"
        if token.text not in ITEM_WORDS:
            return False
        if before.text == "." and not self._is_word(index + 1):
            return False
        if depth:
            if self._text(index + 1) in _BEHIND_NAME:
                return False
            return self._source.begins_line(index) or before.text in (";", "}")
        if token.text == "if" and before.text == "then":
            return self._source.begins_line(index) and not self._is_exempting(index)
        is_head = before.text in ITEM_WORDS and before.text != "if"
        is_name = is_head and not self._is_field(index - 1)
        return self._source.begins_line(index) or (self._ends_item(index - 1) and not is_name)

    def _behind_name(self, index: int) -> int:
        """The token after a name and the dots and words that follow it."""
        index += 1
        while self._text(index) == ".":
            index += 2
        return index

    def _is_exempting(self, index: int) -> bool:
        """Say whether the `then` before a token belongs to an `unless doing SKILL`."""
        before = (token.text for token in reversed(self._tokens[: index - 1]))
        return (
            next((text for text in before if text in (*ITEM_WORDS, "then", "unless")), "")
            == "unless"
        )

    def _begins_unknown(self, first: int, index: int, kind: str | None) -> bool:
        """Say whether an unknown word probably begins an item, as in the line `entitty imu {`."""
        token, before = self._tokens[index], self._tokens[index - 1]
        if token.kind != "word" or not self._source.begins_line(index):
            return False
        is_unfinished = before.text in _NEVER_LAST and not self._is_field(index - 1)
        is_joined = not _JOINING.isdisjoint((token.text, before.text))
        if is_unfinished or is_joined or not self._ends_item(index - 1):
            return False
        if kind in _CONTINUED and {token.text, before.text} & _CONTINUATIONS:
            is_stray = token.text == "when" and before.text not in _CONTINUATIONS
            return is_stray and self._names_something(index + 1)
        if token.text == "topic":
            return kind != "input" or any(self._text(at) == "topic" for at in range(first, index))
        if token.text in RESERVED:
            return token.text == "then" and kind != "rule"
        return self._names_something(index + 1)

    def _names_something(self, index: int) -> bool:
        """Say whether the token after a word fits a declaration, as in `entitty` or `limit`."""
        if self._text(index) in (":", "="):
            return True
        return self._is_word(index) and not self._begins_item(index, 0)

    def _is_word(self, index: int) -> bool:
        """Say whether a token is a text, or a word that neither continues nor begins an item."""
        if index == len(self._tokens):
            return False
        token = self._tokens[index]
        if token.kind != "word":
            return token.kind == "text"
        return token.text not in _NEVER_DECLARED

    def _is_kind(self, index: int, kind: str) -> bool:
        return index < len(self._tokens) and self._tokens[index].kind == kind

    def _meant(self, index: int) -> str | None:
        """The item word that is most similar to this word."""
        token = self._tokens[index]
        if token.kind != "word" or self._text(index + 1) in (":", "=", ".", ";"):
            return None
        if token.text in MEANT:
            return MEANT[token.text]
        return nearest(token.text.lower(), ITEM_WORDS)

    def _ends_item(self, index: int) -> bool:
        token = self._tokens[index]
        is_value = token.kind != "open_text" and ends_value(token)
        return token.text == "}" or is_value or self._is_field(index)

    def _is_field(self, index: int) -> bool:
        """Say whether a token is a word after a dot, which has no other meaning."""
        behind_dot = index > 0 and self._tokens[index - 1].text == "."
        return behind_dot and self._tokens[index].kind == "word"

    def _text(self, index: int) -> str:
        return self._tokens[index].text if index < len(self._tokens) else ""
