"""Common code for recovering items in braces: the place of the body, and its parts."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple, TypeVar

from dslkit.diagnostics import Label
from rossmarie.syntax import ast
from rossmarie.syntax.errors import UnclosedBracket
from rossmarie.syntax.explain import is_name, missing_sign, unclosed_bracket
from rossmarie.syntax.grammar import ParseFailure
from rossmarie.syntax.part import PartParser

_Node = TypeVar("_Node")


class TokenStretch(NamedTuple):
    """The tokens of an item, and its kind. `head` is the correct word if the first word is
    misspelt.
    """

    kind: str
    first: int
    last: int
    head: str | None


class MemberTokens(NamedTuple):
    """The tokens of a part inside braces, without its `;`."""

    first: int
    last: int
    is_closed: bool


def start_of_body(part: PartParser, item: TokenStretch, failure: ParseFailure | None) -> int:
    """The first token after the `{`. Errors before it are reported here."""
    if failure is not None and failure.index <= 2:
        part.explain(item.kind, item.first, item.last, failure)
    for index in range(item.first + 1, min(item.first + 5, item.last)):
        if part.source.tokens[index].text == "{":
            return index + 1
    return min(item.first + 2, item.last)


def check_closed(part: PartParser, item: TokenStretch, start: int) -> None:
    """Report the brace before `start` if it is still open at the end of the item."""
    tokens = part.source.tokens
    inside = tokens[item.first : item.last]
    balance = sum((token.text == "{") - (token.text == "}") for token in inside)
    is_cut_off = any(token.kind == "open_text" for token in inside)
    if balance <= 0 or is_cut_off or tokens[start - 1].text != "{":
        return
    labels: tuple[Label, ...] = ()
    if item.last < len(tokens):
        next_item = part.source.span(tokens[item.last])
        labels = (UnclosedBracket.NextItem().at(next_item),)
    brace = tokens[start - 1]
    part.findings.add(unclosed_bracket(part.source, brace, tokens[item.last - 1], *labels))


def parse_members(
    part: PartParser,
    members: Iterator[MemberTokens],
    kind: Callable[[MemberTokens], str],
    rescue: Callable[[PartParser, MemberTokens], _Node | None],
) -> list[_Node]:
    """The nodes of all members. For a broken member, it is the result of `rescue`."""
    nodes = []
    for member in members:
        if part.findings.is_full:
            break
        node = part.parse(kind(member), member.first, member.last)
        if node is None:
            node = rescue(part, member)
        elif not member.is_closed:
            behind = part.source.tokens[member.last - 1]
            part.findings.add(missing_sign(part.source, ";", behind, kind(member)))
        if node is not None:
            nodes.append(node)
    return nodes


def name_of(part: PartParser, item: TokenStretch) -> ast.Name | None:
    """The name after the first word of an item."""
    if item.last - item.first < 2:
        return None
    token = part.source.tokens[item.first + 1]
    return ast.Name(token.text, part.source.span(token)) if is_name(token) else None
