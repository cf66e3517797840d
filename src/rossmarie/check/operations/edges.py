"""Counts of the edges of a condition, and their comparison with a constant."""

from __future__ import annotations

from rossmarie.check.operations.function_errors import EdgeCount, EdgesMisused
from rossmarie.check.operations.operands import (
    duration_ns,
    is_edge_count,
    require_condition,
    require_constant,
)
from rossmarie.check.scopes.context import Context
from rossmarie.check.wording.describe import describe
from rossmarie.syntax import ast
from rossmarie.types import Boolean, Operator, Quantity, Type, Unknown
from rossmarie.units import DIMENSIONLESS

MOST_EDGES = 64


def type_of_edges(node: ast.Edges, context: Context) -> Type:
    """`edges of condition within 10 sec`. The function around it checks the rest."""
    if node.window is None:
        finding = EdgesMisused(reason="the time after `within` is missing")
        context.collector.add(finding.at(node.span))
    else:
        duration_ns(node.window, "the time after `within`", context)
    require_condition(node.condition, context)
    return Boolean()


def report_edges_elsewhere(node: ast.Expression, function: str, context: Context) -> bool:
    """Report edges in a function other than `count`. Returns True if there are any."""
    if not isinstance(node, ast.Edges) or function == Operator.COUNT.value:
        return False
    finding = EdgesMisused(reason=f"only `count` takes edges, not `{function}`")
    context.collector.add(finding.at(node.span))
    return True


def type_of_edge_comparison(operator: Operator, node: ast.Binary, context: Context) -> Type:
    """The type of `count(edges of condition within 10 sec) > 3`, also with the constant first."""
    if is_edge_count(node.left) and is_edge_count(node.right):
        finding = EdgesMisused(reason="two counts are compared")
        context.collector.add(finding.at(node.span))
        return Boolean()
    is_behind = is_edge_count(node.left)
    bound = node.right if is_behind else node.left
    sides = {Operator.GREATER_OR_EQUAL, Operator.LESS} if is_behind else _MIRRORED
    if require_constant(bound, "the number of edges", context):
        _check_number(bound, always=operator in sides, context=context)
    return Boolean()


_MIRRORED = {Operator.LESS_OR_EQUAL, Operator.GREATER}


def _check_number(bound: ast.Expression, *, always: bool, context: Context) -> None:
    type_ = context.type_of(bound)
    if isinstance(type_, Unknown):
        return
    if not isinstance(type_, Quantity) or type_.unit != DIMENSIONLESS:
        reason = f"this is {describe(type_)}"
    else:
        (number,) = context.values[bound].numbers
        if number.is_integer() and 0 <= number <= MOST_EDGES:
            if number > 0 or not always:
                return
            reason = "no count is below 0, so this never changes"
        else:
            reason = f"this is {number:.15g}"
    context.collector.add(EdgeCount(reason=reason, most=MOST_EDGES).at(bound.span))
