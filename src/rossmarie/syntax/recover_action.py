"""Recovers an action that does not parse as a whole: its effects are parsed one by one."""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import DidYouMean, Edit, Fix
from rossmarie.syntax import ast, errors
from rossmarie.syntax.explain import explain_token, missing_sign
from rossmarie.syntax.grammar import ParseFailure
from rossmarie.syntax.part import PartParser
from rossmarie.syntax.recover_parts import (
    MemberTokens,
    TokenStretch,
    check_closed,
    name_of,
    start_of_body,
)
from rossmarie.syntax.words import EFFECT_WORDS, nearest

_BEHIND_FIELD = frozenset({"=", ".", "[", "in"})


def recover_action(
    part: PartParser, item: TokenStretch, failure: ParseFailure | None
) -> ast.Action | None:
    """Recover the readable effects of an action. `failure` is None if the action exceeds a
    limit.
    """
    tokens = part.source.tokens
    start = start_of_body(part, item, failure)
    has_body = tokens[start - 1].text == "{"
    end = _end_of_body(part, start, item.last) if has_body else item.first
    effects = tuple(_effects(part, start, end)) if has_body else ()
    latch = _latch(part, end + 1, item.last) if has_body else None
    if has_body and end == item.last:
        check_closed(part, item, start)
    name = name_of(part, item)
    if name is None:
        return None
    last = tokens[min(end, item.last - 1)]
    body = part.source.span(tokens[start - 1], last) if has_body else None
    span = part.source.span(tokens[item.first], tokens[item.last - 1])
    documentation = part.source.documentation.get(span.start)
    return ast.Action(name, body, effects, latch, documentation, span)


def _end_of_body(part: PartParser, first: int, last: int) -> int:
    """The index of the closing brace; `last` if there is none. An effect on a line of its own
    closes all braces of the effect before it.
    """
    depth = 0
    for index in range(first, last):
        if _begins_effect(part, index):
            depth = 0
        text = part.source.tokens[index].text
        depth += (text == "{") - (text == "}")
        if depth < 0:
            return index
    return last


def _effects(part: PartParser, first: int, last: int) -> Iterator[ast.Effect]:
    for member in _members(part, first, last):
        if part.findings.is_full:
            return
        effect = _effect(part, member)
        if effect is not None:
            yield effect


def _effect(part: PartParser, member: MemberTokens) -> ast.Effect | None:
    """The effect in a range, even if its first word is misspelt."""
    token = part.source.tokens[member.first]
    meant = None
    if token.text not in EFFECT_WORDS:
        if token.text == "{" and member.last == member.first + 1:
            return None  # the unclosed effect is reported
        if token.kind != "word" or not token.text.isascii():
            part.findings.add(explain_token(part.source, member.first, "effect"))
            return None
        meant = nearest(token.text.lower(), EFFECT_WORDS)
        _report_unknown(part, member.first, meant)
        if meant is None:
            return None
    kind = EFFECT_WORDS[meant or token.text]
    effect: ast.Effect | None = part.parse(kind, member.first, member.last, meant)
    if effect is not None and not member.is_closed:
        behind = part.source.tokens[member.last - 1]
        part.findings.add(missing_sign(part.source, ";", behind, kind))
    return effect


def _report_unknown(part: PartParser, index: int, meant: str | None) -> None:
    token = part.source.tokens[index]
    span = part.source.span(token)
    shown = token.text if len(token.text) <= 40 else f"{token.text[:37]}..."
    finding = errors.UnknownEffect(found=shown)
    help = DidYouMean(near=meant) if meant else finding.NoEffectWord()
    fix = Fix(f"write `{meant}`", (Edit(span, meant),)) if meant else None
    part.findings.add(finding.at(span, help=help, fix=fix))


def _members(part: PartParser, first: int, last: int) -> Iterator[MemberTokens]:
    """Cut at each `;` outside of inner braces, and before an effect on a line of its own."""
    tokens = part.source.tokens
    start = first
    depth = 0
    for index in range(first, last):
        text = tokens[index].text
        if start < index and _begins_effect(part, index):
            yield MemberTokens(start, index, False)
            start, depth = index, 0
        depth += (text == "{") - (text == "}")
        if text == ";" and depth <= 0:
            if start < index:
                yield MemberTokens(start, index, True)
            start, depth = index + 1, 0
    if start < last:
        is_cut_off = last == len(tokens) or tokens[last].text != "}"
        yield MemberTokens(start, last, is_cut_off)


def _begins_effect(part: PartParser, index: int) -> bool:
    tokens = part.source.tokens
    behind = tokens[index + 1].text if index + 1 < len(tokens) else ""
    is_word = tokens[index].text in EFFECT_WORDS and behind not in _BEHIND_FIELD
    return is_word and part.source.begins_line(index)


def _latch(part: PartParser, first: int, last: int) -> ast.LatchedUntilReset | None:
    last -= part.source.tokens[last - 1].text == ";"
    if first >= last:
        return None
    contract = part.parse("contract", first, last)
    return contract if isinstance(contract, ast.LatchedUntilReset) else None
