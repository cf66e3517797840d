"""Expressions over the elements of an array: they may use one array, and constants."""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Label
from rossmarie.check.context import Context
from rossmarie.check.trees import text_of
from rossmarie.check.type_errors import ElementwiseMixture
from rossmarie.syntax import ast
from rossmarie.syntax.walk import children
from rossmarie.types import Array, Unknown


def check_elements(argument: ast.Expression, function: str, context: Context) -> None:
    """Report what else than one array and constants the argument of a fold is made of."""
    first: ast.Expression | None = None
    for part in _parts(argument, context):
        is_array = isinstance(context.type_of(part), Array)
        if is_array and first is None:
            first = part
            continue
        if is_array and first is not None and _spelling(part) == _spelling(first):
            continue
        found = "this is another array" if is_array else "this changes from message to message"
        finding = ElementwiseMixture(found=found, function=function, text=text_of(part))
        labels = () if first is None else (Label(first.span, "the array"),)
        context.collector.add(finding.at(part.span, *labels))


def _parts(argument: ast.Expression, context: Context) -> Iterator[ast.Expression]:
    """The arrays, and the changing single values, in the order in which they are written."""
    pending = [argument]
    while pending:
        node = pending.pop()
        type_ = context.type_of(node)
        if id(node) in context.values or isinstance(type_, Unknown):
            continue
        is_chain = isinstance(node, ast.Reference | ast.Member)
        if is_chain or not isinstance(type_, Array):
            yield node
        else:
            pending.extend(reversed(children(node)))


def _spelling(node: ast.Expression) -> str:
    return "".join(node.span.text.split())
