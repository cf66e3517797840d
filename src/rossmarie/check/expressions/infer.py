"""The type of every expression, and the values of constant expressions.

The pass visits a tree from the leaves up, without recursion, and each node once, after its operands
have types. A type error is reported at its node, which gets the type `Unknown`. No further error is
reported for an `Unknown`.
"""

from __future__ import annotations

from dslkit.source import Span
from rossmarie.check.names.references import is_value, type_of_member, type_of_reference
from rossmarie.check.operations.constants import fold, record
from rossmarie.check.operations.edges import type_of_edges
from rossmarie.check.operations.functions import type_of_call, type_of_oscillates
from rossmarie.check.operations.indexes import element_of, no_element
from rossmarie.check.operations.lists import type_of_list_fold
from rossmarie.check.operations.operators import type_of_binary, type_of_unary
from rossmarie.check.operations.ranges import type_of_bracket, type_of_membership
from rossmarie.check.operations.sectors import type_of_sector
from rossmarie.check.operations.temporal import type_of_temporal
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import text_of
from rossmarie.check.skills.doing import type_of_doing
from rossmarie.check.units.quantities import read_unit
from rossmarie.syntax import ast
from rossmarie.syntax.walk import children
from rossmarie.types import Boolean, Quantity, Text, Type, Unknown
from rossmarie.units import DIMENSIONLESS

_Operation = (
    ast.Unary
    | ast.Binary
    | ast.Membership
    | ast.Held
    | ast.Since | ast.Once | ast.Response
    | ast.Call
    | ast.Edges
    | ast.Oscillates
    | ast.ListFold
    | ast.Bracket
)  # fmt: skip


def infer(expression: ast.Expression, context: Context) -> Type:
    """The type of an expression. `context` receives the types and values of all its parts."""
    pending = [(expression, False)]
    while pending:
        node, is_ready = pending.pop()
        if is_ready:
            context.types[node] = _type_of(node, context)
            _fold(node, context)
        else:
            pending.append((node, True))
            operands = _operands(node, context)
            for part in operands:
                context.parents[part] = node
            pending.extend((part, False) for part in reversed(operands))
    return context.types[expression]


def _operands(node: ast.Expression, context: Context) -> tuple[ast.Expression, ...]:
    if isinstance(node, ast.Member) and not is_value(node, context):
        return ()
    return children(node)


def _fold(node: ast.Expression, context: Context) -> None:
    type_ = context.types[node]
    if node in context.values or isinstance(type_, Unknown):
        return
    value = fold(node, type_, context)
    if value is not None and not record(node, value, context):
        context.types[node] = Unknown()


def _type_of(node: ast.Expression, context: Context) -> Type:
    match node:
        case ast.Number():
            return _type_of_number(node, context)
        case ast.Boolean():
            return Boolean()
        case ast.Text():
            return Text()
        case ast.Reference():
            return type_of_reference(node, context)
        case ast.Member():
            return type_of_member(node, context)
        case ast.Index():
            return _type_of_index(node, context)
        case ast.Sector():
            return type_of_sector(node, context)
        case ast.Parenthesized():
            return context.type_of(node.inner)
        case ast.Doing():
            return type_of_doing(node, context)
        case ast.Broken():
            return Unknown()
        case (
            ast.Unary() | ast.Binary() | ast.Membership() | ast.Held() | ast.Since()
            | ast.Once() | ast.Response() | ast.Call() | ast.Edges() | ast.Oscillates()
            | ast.ListFold() | ast.Bracket()
        ):  # fmt: skip
            return _type_of_operation(node, context)


def _type_of_operation(node: _Operation, context: Context) -> Type:
    match node:
        case ast.Unary():
            return type_of_unary(node, context)
        case ast.Binary():
            return type_of_binary(node, context)
        case ast.Membership():
            return type_of_membership(node, context)
        case ast.Held() | ast.Since() | ast.Once() | ast.Response():
            return type_of_temporal(node, context)
        case ast.Call():
            return type_of_call(node, context)
        case ast.Edges():
            return type_of_edges(node, context)
        case ast.Oscillates():
            return type_of_oscillates(node, context)
        case ast.ListFold():
            return type_of_list_fold(node, context)
        case ast.Bracket():
            return type_of_bracket(node, context)


def _type_of_number(node: ast.Number, context: Context) -> Type:
    if node.unit is None:
        return Quantity(DIMENSIONLESS)
    unit = read_unit(node.unit, context.collector)
    return Unknown() if unit is None else Quantity(unit)


def _type_of_index(node: ast.Index, context: Context) -> Type:
    type_ = context.type_of(node.value)
    if node.constant is not None:
        context.used_names.add(node.constant.text)
    found = element_of(type_, node.index)
    if found is None and not isinstance(type_, Unknown):
        value = node.value.span
        place = Span(value.file, value.end, node.span.end)
        context.collector.add(no_element(type_, node.index, value, text_of(node.value), place))
    return Unknown() if found is None else found
