"""Readings of a laser scan that are compared although they may not be distances.

Many lidars report 0 if nothing returns. An input of the whole scan, or of its `ranges`, can use a
sector instead: a sector contains only the readings that are valid distances (S71).
"""

from __future__ import annotations

from rossmarie.check.operations.elements import parts_of
from rossmarie.check.operations.sector_errors import RawReadings
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import quoted, stripped
from rossmarie.syntax import ast
from rossmarie.types import Array

_ABOVE = (ast.BinaryOperator.GREATER, ast.BinaryOperator.GREATER_OR_EQUAL)
_BELOW = (ast.BinaryOperator.LESS, ast.BinaryOperator.LESS_OR_EQUAL)


def warn_of_raw_readings(fold: ast.Call, context: Context) -> None:
    """Warn of a fold over all readings of a scan whose result an invalid reading can decide."""
    (argument,) = fold.arguments
    raw = [part for part in parts_of(argument, context) if _is_raw(part, context)]
    if not raw or fold.function.text == "max" or _is_bounded_below(argument, context):
        return
    if fold.function.text in ("any", "count") and _asks_what_is_far(argument, context):
        return
    text = quoted(raw[0].span.text)
    finding = RawReadings(text=text)
    context.collector.add(finding.at(raw[0].span, help=finding.Sector(text=text)))


def warn_of_raw_reading(comparison: ast.Binary | ast.Membership, context: Context) -> None:
    """Warn of the comparison of a single reading whose result an invalid reading can decide."""
    sides = (
        (comparison.left, comparison.right)
        if isinstance(comparison, ast.Binary)
        else (comparison.value,)
    )
    for side in sides:
        node = stripped(side)
        if not isinstance(node, ast.Index) or not _is_raw(stripped(node.value), context):
            continue
        if _asks_what_is_far(comparison, context) or _is_bounded_below(comparison, context):
            return
        finding = RawReadings(text=quoted(node.span.text))
        help = finding.Angle(text=quoted(stripped(node.value).span.text))
        context.collector.add(finding.at(node.span, help=help))


def _is_raw(part: ast.Expression, context: Context) -> bool:
    """Say whether an expression is all readings of a scan, unchanged."""
    if not isinstance(part, ast.Reference | ast.Member):
        return False
    type_ = context.type_of(part)
    return isinstance(type_, Array) and type_.has_sectors


def _is_bounded_below(condition: ast.Expression, context: Context) -> bool:
    """Say whether a condition requires a range that begins above 0."""
    node = stripped(condition)
    if not isinstance(node, ast.Membership) or node.is_negated:
        return False
    value = context.values.get(node.container)
    return value is not None and bool(value.numbers) and value.numbers[0] > 0.0


def _asks_what_is_far(condition: ast.Expression, context: Context) -> bool:
    """Say whether a condition is true only for readings above a limit, so that a reading of 0 is
    excluded.
    """
    node = stripped(condition)
    if not isinstance(node, ast.Binary):
        return False
    if node.operator in _ABOVE:
        return not _has_readings(node.right, context)
    return node.operator in _BELOW and not _has_readings(node.left, context)


def _has_readings(side: ast.Expression, context: Context) -> bool:
    node = stripped(side)
    if isinstance(node, ast.Index) and _is_raw(stripped(node.value), context):
        return True
    return isinstance(context.type_of(side), Array)
