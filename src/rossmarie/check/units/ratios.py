"""Ratios from 0 to 1, compared with numbers that are probably meant as percent."""

from __future__ import annotations

from dslkit.diagnostics import Edit, Fix
from dslkit.source import Span
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import literal_of, path_of, root_of, stripped, text_of
from rossmarie.check.units.errors import RatioOutOfRange
from rossmarie.syntax import ast
from rossmarie.types import RATIOS


def check_ratio(value: ast.Expression, bound: ast.Expression, context: Context) -> None:
    """Report `value` if it is a ratio from 0 to 1 and `bound` is a plain number, or range,
    above 1.
    """
    field = _ratio(value, context)
    known = context.values.get(bound)
    if field is None or known is None:
        return
    literal = literal_of(bound, context.declarations)
    if literal is None or literal.unit is not None:
        return
    # Ends of a range that have their own units are not plain numbers.
    is_plain = isinstance(literal, ast.Number) or all(
        isinstance(end, ast.Number) and end.unit is None for end in literal.elements
    )
    if not is_plain or max(known.numbers) <= 1:
        return
    text = text_of(literal)
    finding = RatioOutOfRange(field=field, text=text)
    fix = None
    if literal is stripped(bound):
        behind = Span(literal.span.file, literal.span.end, literal.span.end)
        fix = Fix(f"write `{text} %`", (Edit(behind, " %"),))
    context.collector.add(finding.at(bound.span, fix=fix))


def _ratio(node: ast.Expression, context: Context) -> str | None:
    """The full name of the field that a node reads, if the field is a ratio."""
    root = root_of(node)
    found = context.inputs.get(root.name.text) if root is not None else None
    if found is None:
        return None
    field = ".".join((found.message_type, *found.path, *path_of(node)))
    return field if field in RATIOS else None
