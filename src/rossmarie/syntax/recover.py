"""Items that do not parse as a whole: their parts are parsed one by one.

Each error costs only its own part. An item with a readable name keeps the name, with `ast.Broken`
as its value, so that later stages do not report the name as undeclared. Every failed item has at
least one finding.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dslkit.diagnostics import Edit, Fix
from rossmarie.syntax import ast, errors
from rossmarie.syntax.explain import is_name
from rossmarie.syntax.grammar import ParseFailure
from rossmarie.syntax.part import PartParser
from rossmarie.syntax.recover_action import recover_action
from rossmarie.syntax.recover_parts import (
    MemberTokens,
    TokenStretch,
    check_closed,
    name_of,
    parse_members,
    start_of_body,
)
from rossmarie.syntax.recover_rule import recover_rule
from rossmarie.syntax.recover_test import recover_test
from rossmarie.syntax.scan import Token
from rossmarie.syntax.words import FORMS, MEMBER_WORDS


def recover(part: PartParser, item: TokenStretch, failure: ParseFailure | None) -> ast.Item | None:
    """Recover the readable parts of a failed item. `failure` is None if the item exceeds a
    limit.
    """
    before = part.findings.count
    saved: ast.Item | None
    if item.kind == "rule":
        saved = recover_rule(part, item.first, item.last, item.head)
    elif item.kind == "action":
        saved = recover_action(part, item, failure)
    elif item.kind == "test":
        saved = recover_test(part, item, failure)
    elif item.kind in ("entity", "motion"):
        saved = _recover_entity(part, item, failure)
    elif item.kind == "zone":
        saved = _recover_zone(part, item, failure)
    elif item.kind == "system":
        saved = _recover_system(part, item, failure)
    else:
        is_path = item.kind == "import_item" and _report_unquoted(part, item)
        if not is_path:
            part.parse(item.kind, item.first, item.last, item.head)
        saved = _recover_simple(part, item)
    if failure is not None and part.findings.count == before:
        part.explain(item.kind, item.first, item.last, failure)
    return saved


# --- items without braces ------------------------------------------------------------------------


def _recover_simple(part: PartParser, item: TokenStretch) -> ast.Item | None:
    source = part.source
    span = source.span(source.tokens[item.first], source.tokens[item.last - 1])
    if item.kind == "import_item":
        return _recover_import(part, item)
    if item.kind == "skills":
        return None
    name = name_of(part, item)
    if name is None:
        return None
    documentation = source.documentation.get(span.start)
    if item.kind == "constant":
        value = part.broken(item.first + 3, item.last, name.span)
        return ast.Constant(name, value, documentation, span)
    if item.kind == "parameter":
        value = part.broken(item.first + 3, item.last, name.span)
        return ast.Parameter(name, value, None, documentation, span)
    if item.kind == "hazard":
        return ast.Hazard(name, ast.Text("", name.span), documentation, span)
    unreadable = ast.Name("", name.span)
    return ast.Input(name, unreadable, None, (), None, None, None, documentation, span)


def _recover_import(part: PartParser, item: TokenStretch) -> ast.Import | None:
    """Recover `import husky.ross` and `import "husky.ross`, which count as imports."""
    tokens = part.source.tokens
    if item.last - item.first < 2:
        return None
    path = part.source.span(tokens[item.first + 1], tokens[item.last - 1])
    text = ast.Text(path.text.strip("\"'; \t\r"), path)
    return ast.Import(text, part.source.span(tokens[item.first], tokens[item.last - 1]))


def _report_unquoted(part: PartParser, item: TokenStretch) -> bool:
    """Report a file name without quotation marks, if this is the error."""
    tokens = part.source.tokens[item.first + 1 : item.last]
    if not tokens or any(token.kind in ("text", "open_text") for token in tokens):
        return False
    path = part.source.span(tokens[0], tokens[-1])
    fix = Fix("put it into quotation marks", (Edit(path, f'"{path.text}"'),))
    finding = errors.MisplacedWord(found=tokens[0].text, before="import", form=FORMS[item.kind])
    part.findings.add(finding.at(path, fix=fix))
    return True


# --- entities, motions and systems ---------------------------------------------------------------


def _recover_entity(
    part: PartParser, item: TokenStretch, failure: ParseFailure | None
) -> ast.Entity | ast.Motion | None:
    start = start_of_body(part, item, failure)
    members = _conditions(part, start, item.last)
    inner = "part" if item.kind == "motion" else "condition"
    conditions = parse_members(part, members, lambda _: inner, _broken_condition)
    check_closed(part, item, start)
    name = name_of(part, item)
    if name is None:
        return None
    span = part.source.span(part.source.tokens[item.first], part.source.tokens[item.last - 1])
    documentation = part.source.documentation.get(span.start)
    kind = ast.Motion if item.kind == "motion" else ast.Entity
    return kind(name, tuple(conditions), documentation, span)


def _recover_zone(
    part: PartParser, item: TokenStretch, failure: ParseFailure | None
) -> ast.Zone | None:
    """A zone with the readable shapes. Without a frame, the zone's own name takes its place."""
    tokens = part.source.tokens
    before = part.findings.count
    start = start_of_body(part, item, failure)
    shapes = _conditions(part, start, item.last)
    found: list[ast.Shape] = parse_members(part, shapes, lambda _: "shape", lambda *_: None)
    if part.findings.count == before:
        check_closed(part, item, start)
    name = name_of(part, item)
    if name is None:
        return None
    has_frame = item.last > item.first + 3 and tokens[item.first + 2].text == "in"
    frame = part.source.span(tokens[item.first + 3]) if has_frame else name.span
    span = part.source.span(tokens[item.first], tokens[item.last - 1])
    documentation = part.source.documentation.get(span.start)
    named = ast.Name(frame.text.strip('"'), frame)
    return ast.Zone(name, named, tuple(found), documentation, span)


def _recover_system(
    part: PartParser, item: TokenStretch, failure: ParseFailure | None
) -> ast.System | None:
    tokens = part.source.tokens

    def kind(member: MemberTokens) -> str:
        return MEMBER_WORDS.get(tokens[member.first].text, "topic_declaration")

    before = part.findings.count
    start = start_of_body(part, item, failure)
    members = parse_members(part, _declarations(part, start, item.last), kind, _broken_topic)
    if part.findings.count == before:
        check_closed(part, item, start)
    name = name_of(part, item)
    if name is None:
        return None
    span = part.source.span(tokens[item.first], tokens[item.last - 1])
    documentation = part.source.documentation.get(span.start)
    return ast.System(name, tuple(members), documentation, span)


def _conditions(part: PartParser, first: int, last: int) -> Iterator[MemberTokens]:
    """Cut at `;`, before `NAME :`, and at `}`."""
    tokens = part.source.tokens
    start = first
    for index in range(first, last):
        text = tokens[index].text
        if text in (";", "}"):
            if start < index:
                yield MemberTokens(start, index, text == ";")
            start = index + 1
        elif start < index and _begins_condition(tokens, index, last):
            yield MemberTokens(start, index, False)
            start = index
    if start < last:
        yield MemberTokens(start, last, False)


def _begins_condition(tokens: Sequence[Token], index: int, last: int) -> bool:
    has_colon = index + 1 < last and tokens[index + 1].text == ":"
    return has_colon and tokens[index].kind == "word"


def _declarations(part: PartParser, first: int, last: int) -> Iterator[MemberTokens]:
    """Cut at `;`, at the `}` of a node, and before a word that begins a declaration."""
    tokens = part.source.tokens
    start = first
    is_node = False
    for index in range(first, last):
        text = tokens[index].text
        if text in MEMBER_WORDS and start < index and part.source.begins_line(index):
            yield MemberTokens(start, index, False)
            start, is_node = index, False
        if start == index:
            is_node = text == "node"
        if text == "}":
            if start < index:
                yield MemberTokens(start, index + is_node, is_node)
            start, is_node = index + 1, False
        elif text == ";" and not is_node:
            if start < index:
                yield MemberTokens(start, index, True)
            start = index + 1
    if start < last:
        yield MemberTokens(start, last, False)


def _broken_condition(part: PartParser, member: MemberTokens) -> ast.Condition | None:
    token = part.source.tokens[member.first]
    if not is_name(token):
        return None
    name = ast.Name(token.text, part.source.span(token))
    value = part.broken(member.first + 2, member.last, name.span)
    span = part.source.span(token, part.source.tokens[member.last - 1])
    return ast.Condition(name, value, part.source.documentation.get(token.start), span)


def _broken_topic(part: PartParser, member: MemberTokens) -> ast.TopicDeclaration | None:
    """`topic /imu/data : ...` and `topic Wrench = ...`: a declaration with an unknown type."""
    tokens = part.source.tokens
    if tokens[member.first].text != "topic" or member.last - member.first < 2:
        return None
    end = member.first + 1
    while end < member.last and tokens[end].text not in (":", "=") and tokens[end].kind != "text":
        end += 1
    name = part.source.span(tokens[member.first + 1], tokens[max(end - 1, member.first + 1)])
    topic = ast.Name(name.text, name)
    span = part.source.span(tokens[member.first], tokens[member.last - 1])
    return ast.TopicDeclaration(None, topic, ast.Name("", name), None, None, span)
