"""The uses of a name to which a Python module assigns the value of an expression."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from dslkit.source.call_site import node_span
from dslkit.source.span import Span


def uses_of(expression: Span) -> list[Span]:
    """The uses of the names to which a module assigns the value of an expression, in order, such as
    `skiros` of `skiros = load().skiros`. The expression may be a part of an assigned tuple.
    """
    file = expression.file
    try:
        tree = ast.parse(file.text)
    except (SyntaxError, ValueError, RecursionError):
        return []
    names = {
        target.id
        for statement in tree.body
        if isinstance(statement, ast.Assign)
        for target, value in _assigned(statement)
        if isinstance(target, ast.Name) and node_span(file, value) == expression
    }
    uses = (each for each in ast.walk(tree) if isinstance(each, ast.Name) and each.id in names)
    spans = (node_span(file, each) for each in uses if isinstance(each.ctx, ast.Load))
    return sorted(spans, key=lambda span: span.start)


def _assigned(statement: ast.Assign) -> Iterator[tuple[ast.expr, ast.expr]]:
    """The targets of an assignment, each with its value."""
    for target in statement.targets:
        yield target, statement.value
        if isinstance(target, ast.Tuple) and isinstance(statement.value, ast.Tuple):
            yield from zip(target.elts, statement.value.elts, strict=False)
