"""Parses one range of tokens as one part of a file. The result is a node, or findings.

The limits of `limits` are checked: a returned node is never nested more deeply than later passes
can handle.
"""

from __future__ import annotations

from typing import Any

from dslkit.source import Span
from rossmarie.syntax import ast, errors
from rossmarie.syntax.build import Builder
from rossmarie.syntax.explain import explain
from rossmarie.syntax.findings import LimitedFindings
from rossmarie.syntax.grammar import ParseFailure, Recognizer
from rossmarie.syntax.limits import MAXIMUM_DEPTH, MAXIMUM_LENGTH, MAXIMUM_NESTING, too_deep
from rossmarie.syntax.scan import ScannedFile
from rossmarie.syntax.walk import depth, expressions

_ITEMS = (
    ast.Action,
    ast.Constant,
    ast.Import,
    ast.Input,
    ast.Entity,
    ast.Condition,
    ast.Motion,
    ast.Parameter,
    ast.Shape,
    ast.Zone,
    ast.Rule,
    ast.Skills,
    ast.Test,
)
_NODES = (*_ITEMS, *ast.Effect.__args__, *ast.Statement.__args__)


class PartParser:
    """Parses parts of one file."""

    def __init__(self, source: ScannedFile, findings: LimitedFindings) -> None:
        self.source = source
        self.findings = findings
        self._builder = Builder(source, findings.add)
        self._recognizer = Recognizer(source, self._builder)

    def attempt(self, kind: str, first: int, last: int, head: str | None = None) -> Any:
        """The node for the tokens from `first` up to, not including, `last`; or the `ParseFailure`.

        A failure is not reported. Returns None if the part exceeds a limit.
        """
        is_long = last - first > MAXIMUM_LENGTH
        if is_long or too_deep(self.source.tokens, first, last) is not None:
            return None
        node = self._recognizer.run(kind, first, last, head)
        is_suspect = last - first > MAXIMUM_DEPTH and not isinstance(node, ParseFailure)
        return None if is_suspect and _depth(node) > MAXIMUM_DEPTH else node

    def parse(self, kind: str, first: int, last: int, head: str | None = None) -> Any:
        """The node; None after reporting an error."""
        node = self.attempt(kind, first, last, head)
        if isinstance(node, ParseFailure):
            self.explain(kind, first, last, node)
            return None
        if node is None:
            self._explain_limit(first, last)
        return node

    def explain(self, kind: str, first: int, last: int, failure: ParseFailure) -> None:
        """Report the reason why the tokens cannot be parsed as `kind`."""
        for finding in explain(self.source, first, last, kind, failure):
            self.findings.add(finding)

    def _explain_limit(self, first: int, last: int) -> None:
        tokens = self.source.tokens
        deep = too_deep(tokens, first, last)
        if deep is not None:
            finding = errors.NestingTooDeep(limit=MAXIMUM_NESTING)
            self.findings.add(finding.at(self.source.span(tokens[deep])))
        else:
            long = errors.ExpressionTooLong(limit=MAXIMUM_DEPTH)
            self.findings.add(long.at(self.source.span(tokens[first], tokens[last - 1])))

    def broken(self, first: int, last: int, behind: Span) -> ast.Broken:
        """The node for tokens that could not be parsed; its span is after `behind` if there are
        none.
        """
        if first >= last:
            return ast.Broken(behind)
        tokens = self.source.tokens
        return ast.Broken(self.source.span(tokens[first], tokens[last - 1]))


def _depth(node: Any) -> int:
    roots = expressions(node) if isinstance(node, _NODES) else iter((node,))
    if not isinstance(node, (*_NODES, *ast.Expression.__args__)):
        return 0
    return max((depth(root) for root in roots), default=0)
