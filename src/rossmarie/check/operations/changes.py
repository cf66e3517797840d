"""`changed`: a number, a vector or a flag of a message compared with its previous value."""

from __future__ import annotations

from rossmarie.check.operations.function_errors import ChangedMisused
from rossmarie.check.operations.operands import (
    report_array,
    report_not_a_number,
    report_uncompared,
)
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import stripped, text_of
from rossmarie.check.wording.describe import describe
from rossmarie.syntax import ast
from rossmarie.types import Array, Boolean, Quantity, Text, Type, Unknown, Vector


def type_of_changed(node: ast.Call, context: Context) -> Type:
    """The type of `changed(x)`: one boolean."""
    (argument,) = node.arguments
    type_ = context.type_of(argument)
    if report_uncompared(argument, "it is not one side of a comparison", context):
        return Boolean()
    if isinstance(type_, Quantity | Vector | Unknown):
        return Boolean()
    if isinstance(type_, Boolean) and _is_part_of_a_message(argument, context):
        return Boolean()
    finding = ChangedMisused(found=describe(type_))
    if isinstance(type_, Text):
        help = finding.Compared(text=text_of(argument))
        context.collector.add(finding.at(argument.span, notes=(finding.Texts(),), help=help))
    elif isinstance(type_, Boolean):
        counted = finding.Edges(text=text_of(argument))
        context.collector.add(finding.at(argument.span, help=counted))
    elif isinstance(type_, Array) and isinstance(type_.element, Quantity):
        report_array(argument, context)
        return Unknown()
    else:
        report_not_a_number(argument, context)
    return Boolean()


def _is_part_of_a_message(node: ast.Expression, context: Context) -> bool:
    inner = stripped(node)
    while isinstance(inner, ast.Member | ast.Index | ast.Sector):
        inner = stripped(inner.value)
    return isinstance(inner, ast.Reference) and inner.name.text in context.inputs
