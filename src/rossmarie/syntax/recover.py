"""Items that do not parse as a whole: their parts are parsed one by one.

Each error costs its own part only. What has a readable name keeps it, with `ast.Broken` as its
value, so that later stages do not report the name as undeclared. Every item that fails leaves at
least one finding.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple, TypeVar

from dslkit.diagnostics import Edit, Fix, Label
from rossmarie.syntax import ast, errors
from rossmarie.syntax.explain import is_name, missing_sign, unclosed_bracket
from rossmarie.syntax.grammar import Failure
from rossmarie.syntax.part import PartParser
from rossmarie.syntax.recover_rule import recover_rule
from rossmarie.syntax.scan import Token
from rossmarie.syntax.words import FORMS, MEMBER_WORDS

_Node = TypeVar("_Node")


class Stretch(NamedTuple):
    """The tokens of an item, and its kind; `head` is the word meant where the first is misspelt."""

    kind: str
    first: int
    last: int
    head: str | None


class _Member(NamedTuple):
    """The tokens of a part inside braces, without its `;`."""

    first: int
    last: int
    is_closed: bool


def recover(part: PartParser, item: Stretch, failure: Failure | None) -> ast.Item | None:
    """What can be saved of an item that failed; `failure` is None if it exceeds a limit."""
    before = part.findings.count
    saved: ast.Item | None
    if item.kind == "rule":
        saved = recover_rule(part, item.first, item.last, item.head)
    elif item.kind == "entity":
        saved = _recover_entity(part, item, failure)
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


def _recover_simple(part: PartParser, item: Stretch) -> ast.Item | None:
    source = part.source
    span = source.span(source.tokens[item.first], source.tokens[item.last - 1])
    if item.kind == "import_item":
        return _recover_import(part, item)
    name = _name(part, item)
    if name is None:
        return None
    documentation = source.documentation.get(span.start)
    if item.kind == "action":
        return ast.Action(name, None, documentation, span)
    if item.kind == "constant":
        value = part.broken(item.first + 3, item.last, name.span)
        return ast.Constant(name, value, documentation, span)
    unreadable = ast.Name("", name.span)
    return ast.Input(name, unreadable, None, (), None, None, documentation, span)


def _recover_import(part: PartParser, item: Stretch) -> ast.Import | None:
    """`import husky.ross` and `import "husky.ross` still import."""
    tokens = part.source.tokens
    if item.last - item.first < 2:
        return None
    path = part.source.span(tokens[item.first + 1], tokens[item.last - 1])
    text = ast.Text(path.text.strip("\"'; \t\r"), path)
    return ast.Import(text, part.source.span(tokens[item.first], tokens[item.last - 1]))


def _report_unquoted(part: PartParser, item: Stretch) -> bool:
    """Report a file name without quotation marks, if that is what is wrong."""
    tokens = part.source.tokens[item.first + 1 : item.last]
    if not tokens or any(token.kind in ("text", "open_text") for token in tokens):
        return False
    path = part.source.span(tokens[0], tokens[-1])
    fix = Fix("put it into quotation marks", (Edit(path, f'"{path.text}"'),))
    finding = errors.MisplacedWord(found=tokens[0].text, before="import", form=FORMS[item.kind])
    part.findings.add(finding.at(path, fix=fix))
    return True


# --- entities and systems ------------------------------------------------------------------------


def _recover_entity(part: PartParser, item: Stretch, failure: Failure | None) -> ast.Entity | None:
    start = _start_of_body(part, item, failure)
    members = _conditions(part, start, item.last)
    conditions = _parse_members(part, members, lambda _: "condition", _broken_condition)
    _check_closed(part, item, start)
    name = _name(part, item)
    if name is None:
        return None
    span = part.source.span(part.source.tokens[item.first], part.source.tokens[item.last - 1])
    documentation = part.source.documentation.get(span.start)
    return ast.Entity(name, tuple(conditions), documentation, span)


def _recover_system(part: PartParser, item: Stretch, failure: Failure | None) -> ast.System | None:
    tokens = part.source.tokens

    def kind(member: _Member) -> str:
        return MEMBER_WORDS.get(tokens[member.first].text, "topic_declaration")

    before = part.findings.count
    start = _start_of_body(part, item, failure)
    members = _parse_members(part, _declarations(part, start, item.last), kind, _broken_topic)
    if part.findings.count == before:
        _check_closed(part, item, start)
    name = _name(part, item)
    if name is None:
        return None
    span = part.source.span(tokens[item.first], tokens[item.last - 1])
    documentation = part.source.documentation.get(span.start)
    return ast.System(name, tuple(members), documentation, span)


def _start_of_body(part: PartParser, item: Stretch, failure: Failure | None) -> int:
    """The first token behind the `{`; what is wrong in front of it is reported here."""
    if failure is not None and failure.index <= 2:
        part.explain(item.kind, item.first, item.last, failure)
    for index in range(item.first + 1, min(item.first + 5, item.last)):
        if part.source.tokens[index].text == "{":
            return index + 1
    return min(item.first + 2, item.last)


def _check_closed(part: PartParser, item: Stretch, start: int) -> None:
    """Report the brace in front of `start` if it is open at the end of the item."""
    tokens = part.source.tokens
    inside = tokens[item.first : item.last]
    balance = sum((token.text == "{") - (token.text == "}") for token in inside)
    is_cut_off = any(token.kind == "open_text" for token in inside)
    if balance <= 0 or is_cut_off or tokens[start - 1].text != "{":
        return
    labels: tuple[Label, ...] = ()
    if item.last < len(tokens):
        next_item = part.source.span(tokens[item.last])
        labels = (Label(next_item, "the next item begins here"),)
    brace = tokens[start - 1]
    part.findings.add(unclosed_bracket(part.source, brace, tokens[item.last - 1], *labels))


def _parse_members(
    part: PartParser,
    members: Iterator[_Member],
    kind: Callable[[_Member], str],
    rescue: Callable[[PartParser, _Member], _Node | None],
) -> list[_Node]:
    """The nodes of all members; of a broken one what `rescue` makes of it."""
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


def _conditions(part: PartParser, first: int, last: int) -> Iterator[_Member]:
    """Cut at `;`, in front of `NAME :`, and at `}`."""
    tokens = part.source.tokens
    start = first
    for index in range(first, last):
        text = tokens[index].text
        if text in (";", "}"):
            if start < index:
                yield _Member(start, index, text == ";")
            start = index + 1
        elif start < index and _begins_condition(tokens, index, last):
            yield _Member(start, index, False)
            start = index
    if start < last:
        yield _Member(start, last, False)


def _begins_condition(tokens: Sequence[Token], index: int, last: int) -> bool:
    has_colon = index + 1 < last and tokens[index + 1].text == ":"
    return has_colon and tokens[index].kind == "word"


def _declarations(part: PartParser, first: int, last: int) -> Iterator[_Member]:
    """Cut at `;`, at the `}` of a node, and in front of a word that begins a declaration."""
    tokens = part.source.tokens
    start = first
    is_node = False
    for index in range(first, last):
        text = tokens[index].text
        if text in MEMBER_WORDS and start < index and part.source.begins_line(index):
            yield _Member(start, index, False)
            start, is_node = index, False
        if start == index:
            is_node = text == "node"
        if text == "}":
            if start < index:
                yield _Member(start, index + is_node, is_node)
            start, is_node = index + 1, False
        elif text == ";" and not is_node:
            if start < index:
                yield _Member(start, index, True)
            start = index + 1
    if start < last:
        yield _Member(start, last, False)


def _broken_condition(part: PartParser, member: _Member) -> ast.Condition | None:
    token = part.source.tokens[member.first]
    if not is_name(token):
        return None
    name = ast.Name(token.text, part.source.span(token))
    value = part.broken(member.first + 2, member.last, name.span)
    span = part.source.span(token, part.source.tokens[member.last - 1])
    return ast.Condition(name, value, part.source.documentation.get(token.start), span)


def _broken_topic(part: PartParser, member: _Member) -> ast.TopicDeclaration | None:
    """`topic /imu/data : ...` and `topic Wrench = ...`: declared, but of no known type."""
    tokens = part.source.tokens
    if tokens[member.first].text != "topic" or member.last - member.first < 2:
        return None
    end = member.first + 1
    while end < member.last and tokens[end].text not in (":", "=") and tokens[end].kind != "text":
        end += 1
    name = part.source.span(tokens[member.first + 1], tokens[max(end - 1, member.first + 1)])
    topic = ast.Name(name.text, name)
    span = part.source.span(tokens[member.first], tokens[member.last - 1])
    return ast.TopicDeclaration(None, topic, ast.Name("", name), None, span)


def _name(part: PartParser, item: Stretch) -> ast.Name | None:
    """The name behind the first word of an item."""
    if item.last - item.first < 2:
        return None
    token = part.source.tokens[item.first + 1]
    return ast.Name(token.text, part.source.span(token)) if is_name(token) else None
