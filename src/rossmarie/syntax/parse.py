"""The text of a rules file -> its tree, and a finding for every syntax error.

Accepts any text. Each item, and inside a broken item each part, is parsed by itself: a mistake
costs no more than the condition it stands in. Time is linear in the length of the text; nesting,
length and the number of findings are bounded by `limits`.

What does not parse is tried in this order: `respell` corrects capitals and numbers in the whole
file; if the file still does not parse, `habits` mends what is written as in other languages; `cut`
separates the items and `grammar` parses each; of an item that fails, `recover` and `recover_rule`
parse the parts, and `explain` says what is wrong with the rest.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterator
from typing import Any

from dslkit.diagnostics import Collector, Diagnostic, Edit, Fix
from dslkit.source import SourceFile, Span
from rossmarie.syntax import ast, errors
from rossmarie.syntax.cut import Piece, cut
from rossmarie.syntax.explain import (
    explain_token,
    hash_comment,
    is_name,
    is_part_word,
    unclosed_bracket,
    unopened_bracket,
    unterminated_text,
)
from rossmarie.syntax.findings import Findings
from rossmarie.syntax.grammar import Failure
from rossmarie.syntax.habits import mend
from rossmarie.syntax.hidden import hidden_characters
from rossmarie.syntax.limits import MAXIMUM_FILE_SIZE, MAXIMUM_TOKENS
from rossmarie.syntax.part import PartParser
from rossmarie.syntax.recover import Stretch, recover
from rossmarie.syntax.respell import respell
from rossmarie.syntax.scan import Scan, Token, scan
from rossmarie.syntax.words import MEMBER_WORDS

_REST_OF_LINE = re.compile(r"[^\S\n]*(?:\n|\Z)")


def parse(file: SourceFile, collector: Collector) -> ast.Module:
    """The tree of a file. What could not be parsed is reported, and missing or `ast.Broken` there.

    Spans never include the `;` behind an item or condition. An input that could not be parsed has a
    topic without text, a topic declaration that could not be parsed a type without text. A file
    with too many errors is not read to its end, and has no items.
    """
    findings = Findings(collector)
    size = len(file.text.encode("utf-8", errors="surrogatepass"))
    if size > MAXIMUM_FILE_SIZE:
        findings.add(_too_large(file, size, "bytes", MAXIMUM_FILE_SIZE))
        return ast.Module(file, (), is_whole=False)
    source = scan(file)
    if len(source.tokens) > MAXIMUM_TOKENS:
        findings.add(_too_large(file, len(source.tokens), "words and signs", MAXIMUM_TOKENS))
        return ast.Module(file, (), is_whole=False)
    for finding in hidden_characters(source):
        if findings.is_full:
            break
        findings.add(finding)
    _report_trivia(source, findings)
    spelt = respell(source, findings)
    attempt = Findings(Collector())
    items = _items(PartParser(spelt, attempt))
    if attempt.count:
        items = _items(PartParser(mend(spelt, findings), findings))
    if findings.is_full:
        return ast.Module(file, (), is_whole=False)
    return ast.Module(file, tuple(items))


def _report_trivia(source: Scan, findings: Findings) -> None:
    for trivium in source.trivia:
        if findings.is_full:
            break
        if trivium.kind == "open_documentation":
            findings.add(_unterminated_documentation(source, trivium))
        elif trivium.kind == "block_comment":
            findings.add(_block_comment(source, trivium))
        elif trivium.kind == "hash_comment":
            findings.add(hash_comment(source, trivium))
        elif trivium.kind == "quoted_documentation":
            findings.add(_quoted_documentation(source, trivium))


def _items(part: PartParser) -> list[ast.Item]:
    source, findings = part.source, part.findings
    items: list[ast.Item] = []
    is_lost = False
    for piece in cut(source):
        if piece.kind is None:
            is_brace = source.tokens[piece.first].text == "}"
            if not (is_lost and is_brace):
                findings.add(_unknown(source, piece))
                items.extend(_undeclared(part, piece))
            is_lost = not is_brace
        else:
            if piece.head is not None:
                findings.add(_misspelt(source, piece, piece.head))
            item = _item(part, piece, piece.kind)
            items.extend(() if item is None else (item,))
            is_lost = False
        if findings.is_full:
            break
    return items


def _item(part: PartParser, piece: Piece, kind: str) -> ast.Item | None:
    tokens = part.source.tokens
    last = piece.last
    brace = piece.first + 2
    has_body = kind == "action" and brace < last and tokens[brace].text == "{"
    if has_body and is_name(tokens[brace - 1]):
        last = brace
    node = part.attempt(kind, piece.first, last, piece.head)
    if isinstance(node, ast.Action) and has_body:
        return _with_body(part, node, brace, piece.last)
    if isinstance(node, Failure):
        node = _before_stray(part, piece, kind, node)
    if node is None or isinstance(node, Failure):
        stretch = Stretch(kind, piece.first, piece.last, piece.head)
        return recover(part, stretch, node)
    return node  # type: ignore[no-any-return]


def _undeclared(part: PartParser, piece: Piece) -> Iterator[ast.Constant]:
    """`NAME = VALUE` is meant as a constant."""
    tokens = part.source.tokens
    name, value = piece.first, piece.first + 2
    if value >= piece.last or tokens[name + 1].text != "=" or not is_name(tokens[name]):
        return
    node = part.attempt("expression", value, piece.last)
    span = part.source.span(tokens[name])
    if node is None or isinstance(node, Failure):
        node = part.broken(value, piece.last, span)
    whole = part.source.span(tokens[name], tokens[piece.last - 1])
    documentation = part.source.documentation.get(span.start)
    yield ast.Constant(ast.Name(tokens[name].text, span), node, documentation, whole)


def _before_stray(part: PartParser, piece: Piece, kind: str, failure: Failure) -> Any:
    """The item, if it is complete in front of the word at which it failed and that word begins a
    line: then the word, which is reported, has nothing to do with it. Otherwise the failure.
    """
    source, stray = part.source, failure.index
    if not piece.first < stray < piece.last or not source.begins_line(stray):
        return failure
    if not is_name(source.tokens[stray]) or is_part_word(source.tokens[stray]):
        return failure
    node = part.attempt(kind, piece.first, stray, piece.head)
    if node is None or isinstance(node, Failure):
        return failure
    part.findings.add(_unknown(source, Piece(None, stray, piece.last, None)))
    return node


def _with_body(part: PartParser, action: ast.Action, brace: int, last: int) -> ast.Action:
    """The action with its reserved body, which is reported."""
    tokens = part.source.tokens
    body = part.source.span(tokens[brace], tokens[last - 1])
    if tokens[last - 1].text == "}":
        removal = Edit(Span(body.file, action.span.end, body.end), ";")
        fix = Fix("remove the body", (removal,))
        finding = errors.ActionBody(action=action.name.text).at(body, fix=fix)
    else:
        finding = unclosed_bracket(part.source, tokens[brace], tokens[last - 1])
    part.findings.add(finding)
    return dataclasses.replace(action, body=body, span=action.span.to(body))


def _too_large(file: SourceFile, size: int, what: str, limit: int) -> Diagnostic:
    return errors.FileTooLarge(size=size, what=what, limit=limit).at(Span(file, 0, 0))


def _unterminated_documentation(source: Scan, token: Token) -> Diagnostic:
    span = Span(source.file, token.start, token.start + 3)
    end = Span(source.file, token.end, token.end)
    fix = Fix("insert `'''`", (Edit(end, "'''"),))
    return errors.UnterminatedDocumentation().at(span, fix=fix)


def _block_comment(source: Scan, token: Token) -> Diagnostic:
    span = source.span(token)
    lines = token.text.removeprefix("/*").removesuffix("*/").strip().split("\n")
    text = "\n".join(f"// {line.strip()}".rstrip() for line in lines)
    is_last = _REST_OF_LINE.match(source.file.text, token.end) is not None
    fix = Fix("begin it with `//`", (Edit(span, text if is_last else f"{text}\n"),))
    return errors.BlockComment().at(span, fix=fix)


def _quoted_documentation(source: Scan, token: Token) -> Diagnostic:
    span = source.span(token)
    text = f"'''{token.text[3:-3]}'''"
    fix = Fix("write `'''...'''`", (Edit(span, text),))
    problem = "documentation is written `'''...'''`"
    finding = errors.ForeignForm(found='"""', problem=problem)
    return finding.at(span, help="put it between `'''` and `'''`", fix=fix)


def _misspelt(source: Scan, piece: Piece, meant: str) -> Diagnostic:
    found = source.tokens[piece.first]
    fix = Fix(f"write `{meant}`", (Edit(source.span(found), meant),))
    finding = errors.UnknownItem(found=found.text, advice=f"did you mean `{meant}`?")
    return finding.at(source.span(found), fix=fix)


def _unknown(source: Scan, piece: Piece) -> Diagnostic:
    """A stretch at the outermost level that is no item."""
    found = source.tokens[piece.first]
    after = source.tokens[piece.first + 1].text if piece.first + 1 < piece.last else ""
    if found.text in ("}", ")", "]"):
        return unopened_bracket(source, found)
    if found.kind == "open_text":
        return unterminated_text(source, found)
    if found.kind == "sign":
        return explain_token(source, piece.first, "module")
    fix = None
    if found.text in MEMBER_WORDS and after not in ("=", ":"):
        advice = "this belongs inside a system: `system NAME { ... }`"
    elif after == ":":
        advice = "conditions stand inside an entity: `entity NAME { ... }`"
    elif after == "=":
        advice = f"to give a value a name, write `const {found.text} = ...;`"
        fix = Fix("insert `const`", (Edit(Span(source.file, found.start, found.start), "const "),))
    elif found.text == "else":
        advice = "there is no `else`: write another rule, with `not` in front of the condition"
    elif found.text == "then":
        advice = "`then` belongs to a rule: `if CONDITION then { ACTION; };`"
    else:
        advice = "begin with the word that says what it is, such as `const` or `rule`"
    text = found.text if len(found.text) <= 40 else f"{found.text[:37]}..."
    return errors.UnknownItem(found=text, advice=advice).at(source.span(found), fix=fix)
