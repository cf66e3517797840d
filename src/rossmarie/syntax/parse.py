"""Parses a rules file: its tree, and a finding for every syntax error.

Accepts any text. Each item, and inside a broken item each part, is parsed separately, so that a
mistake costs only the condition around it. Time is linear in the length of the text; `limits` bound
nesting, length and the number of findings.

The steps: `respell` corrects capitals and numbers, `cut` separates the items, `grammar` reads each.
If some fail, `habits` corrects notations of other languages in them, and the changed items are read
again. If an item still fails, `recover` and `recover_rule` read its parts, and `explain` reports
the errors in the rest.
"""

from __future__ import annotations

import re

from dslkit.diagnostics import Collector, Diagnostic, Edit, Fix
from dslkit.source import SourceFile, Span
from rossmarie.syntax import ast, errors
from rossmarie.syntax.explain import hash_comment
from rossmarie.syntax.findings import LimitedFindings
from rossmarie.syntax.hidden import hidden_characters
from rossmarie.syntax.items import read_items
from rossmarie.syntax.limits import MAXIMUM_FILE_SIZE, MAXIMUM_TOKENS
from rossmarie.syntax.respell import respell
from rossmarie.syntax.scan import ScannedFile, Token, scan

_REST_OF_LINE = re.compile(r"[^\S\n]*(?:\n|\Z)")


def parse(file: SourceFile, collector: Collector) -> ast.Module:
    """The tree of a file. Text that could not be parsed is reported, and is missing in the tree or
    is an `ast.Broken`.

    Spans never include the `;` after an item or condition. An input that could not be parsed has a
    topic without text. A topic declaration that could not be parsed has a type without text. A file
    with too many errors is not read to its end, and has no items.
    """
    findings = LimitedFindings(collector)
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
    items = () if findings.is_full else tuple(read_items(spelt, findings))
    if findings.is_full:
        return ast.Module(file, (), is_whole=False)
    return ast.Module(file, items)


def _report_trivia(source: ScannedFile, findings: LimitedFindings) -> None:
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


def _too_large(file: SourceFile, size: int, what: str, limit: int) -> Diagnostic:
    return errors.FileTooLarge(size=size, what=what, limit=limit).at(Span(file, 0, 0))


def _unterminated_documentation(source: ScannedFile, token: Token) -> Diagnostic:
    span = Span(source.file, token.start, token.start + 3)
    end = Span(source.file, token.end, token.end)
    fix = Fix("insert `'''`", (Edit(end, "'''"),))
    return errors.UnterminatedDocumentation().at(span, fix=fix)


def _block_comment(source: ScannedFile, token: Token) -> Diagnostic:
    span = source.span(token)
    lines = token.text.removeprefix("/*").removesuffix("*/").strip().split("\n")
    text = "\n".join(f"// {line.strip()}".rstrip() for line in lines)
    is_last = _REST_OF_LINE.match(source.file.text, token.end) is not None
    fix = Fix("begin it with `//`", (Edit(span, text if is_last else f"{text}\n"),))
    return errors.BlockComment().at(span, fix=fix)


def _quoted_documentation(source: ScannedFile, token: Token) -> Diagnostic:
    span = source.span(token)
    text = f"'''{token.text[3:-3]}'''"
    fix = Fix("write `'''...'''`", (Edit(span, text),))
    problem = "documentation is written `'''...'''`"
    finding = errors.ForeignForm(found='"""', problem=problem)
    return finding.at(span, help=finding.Documentation(), fix=fix)
