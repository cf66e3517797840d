"""Conditions over time: `for`, `since`, `once` and `after`.

Their operands are conditions of the whole machine, never of the elements of an array.
"""

from __future__ import annotations

from dslkit.diagnostics import Diagnostic, Edit, Fix
from dslkit.source import Span
from rossmarie.check.operations.elements import (
    Temporal,
    enclosing_fold,
    report_elements_over_time,
)
from rossmarie.check.operations.errors import AmbiguousFor, AmbiguousSince
from rossmarie.check.operations.operands import duration_ns, require_condition
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import quoted, text_of
from rossmarie.syntax import ast
from rossmarie.types import Array, Boolean, Type, Unknown


def type_of_temporal(node: Temporal, context: Context) -> Type:
    """The type of `condition for 2 sec` and similar: one boolean."""
    match node:
        case ast.Held(condition=condition, duration=duration):
            duration_ns(duration, "the time after `for`", context)
            return _type_over_time(node, (condition,), context)
        case ast.Since(held=held, begun=begun):
            return _type_over_time(node, (held, begun), context)
        case ast.Once(condition=condition, duration=duration):
            duration_ns(duration, "the time after `within`", context)
            return _type_over_time(node, (condition,), context)
        case ast.Response(cause=cause, answer=answer, duration=duration):
            duration_ns(duration, "the time after `within`", context)
            return _type_over_time(node, (cause, answer), context)


def _type_over_time(node: Temporal, operands: tuple[ast.Expression, ...], context: Context) -> Type:
    fold = enclosing_fold(node, context)
    if fold is not None and any(
        isinstance(context.type_of(operand), Array | Unknown) for operand in operands
    ):
        for operand in operands:
            if isinstance(context.type_of(operand), Array):
                report_elements_over_time(node, operand, fold, context)
        return Unknown()
    for operand in operands:
        require_condition(operand, context)
    return Boolean()


# --- the scope of operators --------------------------------------------------------------


def report_ambiguous(node: ast.Binary, context: Context) -> None:
    """Report `a and b for 2 sec`, `a and b since c` and `a since b and c`, in which `for` or
    `since` seems to apply to both sides of the `and`.
    """
    first = _first_operand(node.right)
    if isinstance(first, ast.Held):
        context.collector.add(_ambiguous_for(node, first))
    elif isinstance(node.right, ast.Since):
        context.collector.add(_ambiguous_held(node, node.right))
    elif isinstance(node.left, ast.Since):
        context.collector.add(_ambiguous_begun(node, node.left))


def _first_operand(node: ast.Expression) -> ast.Expression:
    while isinstance(node, ast.Binary) and node.operator in ast.JUNCTIONS:
        node = node.left
    return node


def _ambiguous_for(node: ast.Binary, held: ast.Held) -> Diagnostic:
    before, inside, behind = _around(node, held, held.condition)
    finding = AmbiguousFor(
        duration=text_of(held.duration),
        last=text_of(held.condition),
        narrow=quoted(f"{before}({held.span.text})"),
        wide=quoted(f"({inside}){behind}"),
    )
    return finding.at(held.span, fix=_in_parentheses(held))


def _ambiguous_held(node: ast.Binary, since: ast.Since) -> Diagnostic:
    before, inside, behind = _around(node, since, since.held)
    finding = AmbiguousSince(
        near=text_of(since.held),
        narrow=quoted(f"{before}({since.span.text})"),
        wide=quoted(f"({inside}){behind}"),
    )
    return finding.at(since.span, fix=_in_parentheses(since))


def _ambiguous_begun(node: ast.Binary, since: ast.Since) -> Diagnostic:
    file = since.span.file
    before = Span(file, since.span.start, since.begun.span.start).text
    inside = Span(file, since.begun.span.start, node.right.span.end).text
    behind = Span(file, since.span.end, node.right.span.end).text
    finding = AmbiguousSince(
        near=text_of(since.begun),
        narrow=quoted(f"({since.span.text}){behind}"),
        wide=quoted(f"{before}({inside})"),
    )
    return finding.at(since.span, fix=_in_parentheses(since))


def _around(
    node: ast.Binary, temporal: ast.Held | ast.Since, last: ast.Expression
) -> tuple[str, str, str]:
    """Three texts around an operator over time: the text before it, the text up to its word, and
    the rest.
    """
    file, start = temporal.span.file, node.left.span.start
    before = Span(file, start, temporal.span.start).text
    inside = Span(file, start, last.span.end).text
    behind = Span(file, last.span.end, temporal.span.end).text
    return before, inside, behind


def _in_parentheses(node: ast.Held | ast.Since) -> Fix:
    start, end = node.span.start, node.span.end
    edits = (
        Edit(Span(node.span.file, start, start), "("),
        Edit(Span(node.span.file, end, end), ")"),
    )
    return Fix(f"write `({text_of(node)})`", edits)
