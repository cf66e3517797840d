"""Replace frequent mistakes, and notations of other languages, by the intended tokens.

Each habit is a pattern over the tokens of a file, written with one space between two tokens (a line
feed at the end of a line). Its group `x` is the mistake. The correction replaces the group, so a
mistake costs one finding and nothing around it. Only text that does not parse is searched, so
correct text is never changed.
"""

from __future__ import annotations

import dataclasses
import re
from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from functools import cache, cached_property, partial
from typing import NamedTuple

from dslkit.diagnostics import Diagnostic, DidYouMean, Edit, Fix, Write
from dslkit.source import Span
from rossmarie.syntax import errors
from rossmarie.syntax.findings import LimitedFindings
from rossmarie.syntax.habit_table import ANY_NAME, HABITS, NEAR_MISSES, PAIRS, Habit, NearMiss
from rossmarie.syntax.scan import ScannedFile, Token, ends_line, tokens_of
from rossmarie.syntax.words import MEMBER_WORDS, PART_WORDS, RESERVED, nearest

_KEYWORDS = RESERVED | MEMBER_WORDS.keys() | PART_WORDS
_PARTNERS = {"(": ")", "[": "]", "{": "}"}
_ENDS = (")", "]", "%")  # signs that end a value
_LONGEST = 40  # the most letters of a mistake in the title of its finding
_NO_WORD = "this is not a keyword of the language"


class _Change(NamedTuple):
    """The replacement of the tokens from `first` up to, not including, `last` by `tokens`."""

    first: int
    last: int
    tokens: tuple[Token, ...]


_Remedy = Callable[[], tuple[tuple[_Change, ...], Diagnostic]]


def mend(
    source: ScannedFile, kinds: Sequence[str | None], findings: LimitedFindings
) -> ScannedFile:
    """The file with its habits corrected; each habit is reported.

    `kinds` is the kind of the item around each token; None if the item parses.
    """
    changes: dict[int, _Change] = {}
    end = 0
    search = _Search(source, kinds)
    for first, remedy in sorted(search.all(), key=lambda found: found[0]):
        if findings.is_full:
            break
        if first < end or first in changes:
            continue
        group, finding = remedy()
        if not any(change.first in changes for change in group):
            end = group[0].last
            findings.add(finding)
            changes.update({change.first: change for change in group})
    return _changed(source, changes) if changes else source


def _changed(source: ScannedFile, changes: dict[int, _Change]) -> ScannedFile:
    """The file with its changes, by the index of their first token."""
    tokens: list[Token] = []
    reported: set[int] = set()
    index = 0
    while index < len(source.tokens):
        kept = source.tokens[index : index + 1]
        change = changes.get(index) or _Change(index, index + 1, kept)
        tokens += change.tokens
        if index in changes and change.tokens == source.tokens[index : change.last]:
            reported.update(token.start for token in change.tokens)
        index = change.last
    return dataclasses.replace(source, tokens=tuple(tokens), reported=frozenset(reported))


class _Search:
    """Searches one file for all habits."""

    def __init__(self, source: ScannedFile, kinds: Sequence[str | None]) -> None:
        self._source = source
        self._kinds = kinds
        self._tokens = source.tokens
        self._starts: list[int] = []
        pieces: list[str] = []
        length = 0
        end = 0
        for token in source.tokens:
            gap = "\n" if ends_line(source.file.text[end : token.start]) else " "
            shown = '"' if token.kind in ("text", "open_text") else token.text
            pieces += (gap, shown)
            self._starts.append(length + 1)
            length += 1 + len(shown)
            end = token.end
        self._text = "".join((*pieces, "\n"))

    def all(self) -> Iterator[tuple[int, _Remedy]]:
        """The first token of each mistake, and the remedy that creates its changes and its
        finding.
        """
        for habit in HABITS:
            for first, match in self._matches(habit):
                yield first, partial(self._habit, habit, match)
        for near in NEAR_MISSES:
            for first, match in self._matches(near):
                word = match["x"]
                meant = near.others.get(word)
                if meant is None and word not in _KEYWORDS:
                    meant = _nearest(word, near.words)
                if meant is not None:
                    advice = DidYouMean(near=meant)
                    habit = Habit(near.pattern, meant, _NO_WORD, str(advice))
                    yield first, partial(self._habit, habit, match)
        for pair in PAIRS:
            for first, _ in self._matches(pair):
                yield first, partial(self._pair, pair, first)

    def _matches(self, mistake: Habit | NearMiss) -> Iterator[tuple[int, re.Match[str]]]:
        """The matches of a mistake's pattern in text that does not parse, with the first token of
        each.
        """
        for match in mistake.pattern.finditer(self._text):
            first, _ = self._range(match, "x")
            kind = self._kinds[first]
            if kind not in (None, mistake.outside) and mistake.inside in ("", kind):
                yield first, match

    def _range(self, match: re.Match[str], group: str) -> tuple[int, int]:
        start, end = match.span(group)
        return bisect_left(self._starts, start), bisect_left(self._starts, end)

    def _written(self, match: re.Match[str], group: str) -> str:
        first, last = self._range(match, group)
        if first >= last:
            return ""
        return self._source.span(self._tokens[first], self._tokens[last - 1]).text

    def _habit(self, habit: Habit, match: re.Match[str]) -> tuple[tuple[_Change, ...], Diagnostic]:
        first, last = self._range(match, "x")
        span = self._source.span(self._tokens[first], self._tokens[last - 1])
        shown = self._written(match, "x").split("\n")[0][:_LONGEST]
        groups = {name: self._written(match, name) for name in match.groupdict()}
        groups["name"] = _one_word(groups["x"])
        groups["digits"] = groups["x"].replace("_", "")
        groups["text"] = groups["x"][1:-1]
        meant = None if habit.meant is None else habit.meant.format(**groups)
        kept = self._tokens[first:last]
        tokens = kept if meant is None or habit.is_final else _tokens(meant, span)
        if habit.meant is None and habit.drops:
            tokens = ()
        fix = None
        if meant is not None:
            title = f"write `{meant}`" if meant else f"remove `{shown}`"
            fix = Fix(title, (_edit(span, meant),))
        finding = errors.ForeignForm(problem=habit.problem.format(**groups), found=shown)
        change = _Change(first, last, tokens)
        help = finding.Form(form=habit.advice) if habit.advice else Write(meant=meant or "")
        return (change,), finding.at(span, help=help, fix=fix)

    def _pair(self, pair: Habit, first: int) -> tuple[tuple[_Change, ...], Diagnostic]:
        closing = self._partners.get(first)
        places = [first] if closing is None else [first, closing]
        changes: list[_Change] = []
        edits: list[Edit] = []
        for place, sign in zip(places, (pair.meant or "").split(" "), strict=False):
            span = self._source.span(self._tokens[place])
            changes.append(_Change(place, place + 1, _tokens(sign, span)))
            edits.append(_edit(span, sign))
        finding = errors.ForeignForm(problem=pair.problem, found=self._tokens[first].text)
        fix = Fix(f"write `{edits[0].replacement}`", tuple(edits)) if closing is not None else None
        at = self._source.span(self._tokens[first])
        return tuple(changes), finding.at(at, help=finding.Form(form=pair.advice), fix=fix)

    @cached_property
    def _partners(self) -> dict[int, int]:
        """The closing bracket of each closed opening bracket, by index."""
        partners: dict[int, int] = {}
        stack: list[int] = []
        for index, token in enumerate(self._tokens):
            if token.text in _PARTNERS:
                stack.append(index)
            elif token.text in _PARTNERS.values():
                if not stack or _PARTNERS[self._tokens[stack[-1]].text] != token.text:
                    stack.clear()
                else:
                    partners[stack.pop()] = index
        return partners


@cache
def _nearest(word: str, words: tuple[str, ...]) -> str | None:
    return nearest(word, words) if len(word) <= _LONGEST else None


def _edit(span: Span, meant: str) -> Edit:
    """The edit that writes `meant` there. It also removes a superfluous space around removed text
    or before a colon, and adds a space if a word would touch another word.
    """
    text = span.file.text
    before = text[span.start - 1 : span.start]
    has_space = before == " "
    is_alone = meant == "" and text[span.end : span.end + 1].isspace()
    start = span.start - (has_space and (is_alone or meant == ":"))
    gap = " " if meant[:1].isalpha() and (before.isalnum() or before in _ENDS) else ""
    return Edit(Span(span.file, start, span.end), f"{gap}{meant}")


def _one_word(text: str) -> str:
    """A name of several words as one word: `slow_down`."""
    word = re.sub(r"\W+", "_", text).strip("_")
    return word if re.fullmatch(ANY_NAME, word) else f"name_{word}"


def _tokens(text: str, span: Span) -> tuple[Token, ...]:
    """The tokens of a text that replaces the text at `span`."""
    return tuple(Token(token.kind, token.text, span.start, span.end) for token in tokens_of(text))
