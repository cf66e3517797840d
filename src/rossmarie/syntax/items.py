"""The items of a file, each read separately, so that a mistake costs only its item.

Every item is read once. If some fail, `habits` corrects the file, and the changed items are read
again. Items that still fail go to `recover`. Text that begins like no item is reported here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from dslkit.diagnostics import Diagnostic, DidYouMean, Edit, Fix, Remark
from dslkit.source import Span
from rossmarie.syntax import ast, errors
from rossmarie.syntax.cut import TokenRange, cut
from rossmarie.syntax.explain import (
    explain_token,
    is_name,
    is_part_word,
    unopened_bracket,
    unterminated_text,
)
from rossmarie.syntax.findings import LimitedFindings
from rossmarie.syntax.grammar import ParseFailure
from rossmarie.syntax.limits import MAXIMUM_ERRORS
from rossmarie.syntax.part import PartParser
from rossmarie.syntax.recover import recover
from rossmarie.syntax.recover_parts import TokenStretch
from rossmarie.syntax.scan import ScannedFile, Token
from rossmarie.syntax.words import EFFECT_WORDS, MEMBER_WORDS


class _Reading(NamedTuple):
    """The first reading of an item: its place, its tokens, and the result."""

    piece: TokenRange
    tokens: tuple[Token, ...]
    result: Any

    @property
    def is_broken(self) -> bool:
        """True if the item does not parse, or begins like no item."""
        return self.result is None or isinstance(self.result, ParseFailure)


def read_items(source: ScannedFile, findings: LimitedFindings) -> list[ast.Item]:
    """All items, in order. Errors are reported, and as little text as possible is lost."""
    part = PartParser(source, findings)
    readings, kinds = _first_readings(part)
    pieces: Iterable[TokenRange] = (reading.piece for reading in readings.values())
    if any(reading.is_broken for reading in readings.values()):
        from rossmarie.syntax.habits import mend  # this import compiles many patterns

        part = PartParser(mend(source, kinds, findings), findings)
        pieces = cut(part.source)
    items: list[ast.Item] = []
    is_stale = False
    for piece in pieces:
        if piece.kind is None:
            is_brace = part.source.tokens[piece.first].text == "}"
            if not (is_stale and is_brace):
                findings.add(_unknown(part.source, piece))
                items.extend(_undeclared(part, piece))
            is_stale = not is_brace
        else:
            item = _item(part, piece, piece.kind, readings)
            items.extend(() if item is None else (item,))
            is_stale = False
        if findings.is_full:
            break
    return items


def _first_readings(part: PartParser) -> tuple[dict[int, _Reading], list[str | None]]:
    """The reading of each item, by its start; and the kind of the item around each token, None if
    the item parses.

    The function stops after so many broken items that further findings would not be shown.
    """
    tokens = part.source.tokens
    readings: dict[int, _Reading] = {}
    kinds: list[str | None] = [""] * len(tokens)
    failures = 0
    for piece in cut(part.source):
        inside = tokens[piece.first : piece.last]
        reading = _Reading(piece, inside, _attempt(part, piece))
        readings[inside[0].start] = reading
        kind = piece.kind or "" if reading.is_broken else None
        kinds[piece.first : piece.last] = [kind] * len(inside)
        failures += reading.is_broken or piece.head is not None
        if failures > MAXIMUM_ERRORS or part.findings.is_full:
            break
    return readings, kinds


def _attempt(part: PartParser, piece: TokenRange) -> Any:
    """The item; or the `ParseFailure` or None from `PartParser.attempt`."""
    if piece.kind is None:
        return None
    return part.attempt(piece.kind, piece.first, piece.last, piece.head)


def _item(
    part: PartParser, piece: TokenRange, kind: str, readings: Mapping[int, _Reading]
) -> ast.Item | None:
    source = part.source
    if piece.head is not None:
        part.findings.add(_misspelt(source, piece, piece.head))
    inside = source.tokens[piece.first : piece.last]
    reading = readings.get(inside[0].start)
    if reading is None or (reading.piece.kind, reading.tokens) != (kind, inside):
        reading = _Reading(piece, inside, _attempt(part, piece))
    node = reading.result
    if isinstance(node, ParseFailure):
        node = _before_stray(part, piece, kind, node)
    if node is None or isinstance(node, ParseFailure):
        stretch = TokenStretch(kind, piece.first, piece.last, piece.head)
        return recover(part, stretch, node)
    return node  # type: ignore[no-any-return]


def _undeclared(part: PartParser, piece: TokenRange) -> Iterator[ast.Constant]:
    """Constants for `NAME = VALUE`, which is intended as a constant."""
    tokens = part.source.tokens
    name, value = piece.first, piece.first + 2
    if value >= piece.last or tokens[name + 1].text != "=" or not is_name(tokens[name]):
        return
    node = part.attempt("expression", value, piece.last)
    span = part.source.span(tokens[name])
    if node is None or isinstance(node, ParseFailure):
        node = part.broken(value, piece.last, span)
    whole = part.source.span(tokens[name], tokens[piece.last - 1])
    documentation = part.source.documentation.get(span.start)
    yield ast.Constant(ast.Name(tokens[name].text, span), node, documentation, whole)


def _before_stray(part: PartParser, piece: TokenRange, kind: str, failure: ParseFailure) -> Any:
    """The item, if it is complete before the word at which it failed, and if this word begins a
    line. Then the word, which is reported, is not part of the item. Otherwise the failure.
    """
    source, stray = part.source, piece.first + failure.index
    if not piece.first < stray < piece.last or not source.begins_line(stray):
        return failure
    if not is_name(source.tokens[stray]) or is_part_word(source.tokens[stray]):
        return failure
    node = part.attempt(kind, piece.first, stray, piece.head)
    if node is None or isinstance(node, ParseFailure):
        return failure
    part.findings.add(_unknown(source, TokenRange(None, stray, piece.last, None)))
    return node


def _misspelt(source: ScannedFile, piece: TokenRange, meant: str) -> Diagnostic:
    found = source.tokens[piece.first]
    fix = Fix(f"write `{meant}`", (Edit(source.span(found), meant),))
    finding = errors.UnknownItem(found=found.text)
    return finding.at(source.span(found), help=DidYouMean(near=meant), fix=fix)


def _unknown(source: ScannedFile, piece: TokenRange) -> Diagnostic:
    """A range at the outermost level that is not an item."""
    found = source.tokens[piece.first]
    after = source.tokens[piece.first + 1].text if piece.first + 1 < piece.last else ""
    if found.text in ("}", ")", "]"):
        return unopened_bracket(source, found)
    if found.kind == "open_text":
        return unterminated_text(source, found)
    if found.kind == "sign":
        return explain_token(source, piece.first, "module")
    text = found.text if len(found.text) <= 40 else f"{found.text[:37]}..."
    finding = errors.UnknownItem(found=text)
    fix = None
    help: Remark
    if found.text in MEMBER_WORDS and after not in ("=", ":"):
        help = finding.InSystem()
    elif after == ":":
        help = finding.Condition()
    elif after == "=":
        help = finding.Constant(name=found.text)
        fix = Fix("insert `const`", (Edit(Span(source.file, found.start, found.start), "const "),))
    elif found.text == "else":
        help = finding.Else()
    elif found.text in EFFECT_WORDS:
        help = finding.InAction()
    elif found.text == "then":
        help = finding.Then()
    else:
        help = finding.NoItemWord()
    return finding.at(source.span(found), help=help, fix=fix)
