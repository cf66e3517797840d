"""Recovers a test that does not parse as a whole: its statements are parsed one by one."""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Edit, Fix
from rossmarie.syntax import ast, errors
from rossmarie.syntax.explain import explain_token, missing_sign
from rossmarie.syntax.grammar import ParseFailure
from rossmarie.syntax.part import PartParser
from rossmarie.syntax.recover_parts import MemberTokens, TokenStretch, check_closed, start_of_body
from rossmarie.syntax.words import STATEMENT_WORDS, nearest


def recover_test(
    part: PartParser, item: TokenStretch, failure: ParseFailure | None
) -> ast.Test | None:
    """Recover the readable statements of a test. `failure` is None if the test exceeds a limit."""
    tokens = part.source.tokens
    start = start_of_body(part, item, failure)
    has_body = tokens[start - 1].text == "{"
    statements = tuple(_statements(part, start, item.last)) if has_body else ()
    check_closed(part, item, start)
    if item.last - item.first < 2 or tokens[item.first + 1].kind != "text":
        return None
    written = part.source.span(tokens[item.first + 1])
    span = part.source.span(tokens[item.first], tokens[item.last - 1])
    documentation = part.source.documentation.get(span.start)
    return ast.Test(ast.Text(written.text[1:-1], written), statements, documentation, span)


def _statements(part: PartParser, first: int, last: int) -> Iterator[ast.Statement]:
    for member in _members(part, first, last):
        if part.findings.is_full:
            return
        statement = _statement(part, member)
        if statement is not None:
            yield statement


def _members(part: PartParser, first: int, last: int) -> Iterator[MemberTokens]:
    """Cut at each `;`, at `}`, and before a statement on a line of its own."""
    tokens = part.source.tokens
    start = first
    for index in range(first, last):
        text = tokens[index].text
        if start < index and text in STATEMENT_WORDS and part.source.begins_line(index):
            yield MemberTokens(start, index, False)
            start = index
        if text in (";", "}"):
            if start < index:
                yield MemberTokens(start, index, text == ";")
            start = index + 1
    if start < last:
        yield MemberTokens(start, last, True)


def _statement(part: PartParser, member: MemberTokens) -> ast.Statement | None:
    """The statement in a range, even if its first word is misspelt."""
    token = part.source.tokens[member.first]
    meant = None
    if token.text not in STATEMENT_WORDS:
        meant = nearest(token.text.lower(), STATEMENT_WORDS) if token.kind == "word" else None
        if meant is None:
            part.findings.add(explain_token(part.source, member.first, "statement"))
            return None
        span = part.source.span(token)
        fix = Fix(f"write `{meant}`", (Edit(span, meant),))
        finding = errors.UnknownStatement(found=token.text, meant=meant)
        part.findings.add(finding.at(span, fix=fix))
    kind = STATEMENT_WORDS[meant or token.text]
    statement: ast.Statement | None = part.parse(kind, member.first, member.last, meant)
    if statement is not None and not member.is_closed:
        behind = part.source.tokens[member.last - 1]
        part.findings.add(missing_sign(part.source, ";", behind, kind))
    return statement
