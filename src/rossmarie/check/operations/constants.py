"""The values of constant expressions: numbers in SI units, booleans and texts."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from typing import Any

from rossmarie.check.model import Value
from rossmarie.check.operations.errors import ConstantTooLarge
from rossmarie.check.scopes.context import Context
from rossmarie.syntax import ast
from rossmarie.syntax.ast import BinaryOperator
from rossmarie.syntax.walk import children
from rossmarie.types import Boolean, Quantity, Type
from rossmarie.units import DIMENSIONLESS

_BINARY: Mapping[BinaryOperator, Callable[[float, float], float]] = {
    BinaryOperator.ADD: lambda left, right: left + right,
    BinaryOperator.SUBTRACT: lambda left, right: left - right,
    BinaryOperator.MULTIPLY: lambda left, right: left * right,
    BinaryOperator.DIVIDE: lambda left, right: left / right,
}
_COMPARISONS: Mapping[BinaryOperator, Callable[[Any, Any], bool]] = {
    BinaryOperator.EQUAL: operator.eq,
    BinaryOperator.NOT_EQUAL: operator.ne,
    BinaryOperator.LESS: operator.lt,
    BinaryOperator.LESS_OR_EQUAL: operator.le,
    BinaryOperator.GREATER: operator.gt,
    BinaryOperator.GREATER_OR_EQUAL: operator.ge,
}
_JUNCTIONS: Mapping[BinaryOperator, Callable[[bool, bool], bool]] = {
    BinaryOperator.AND: lambda left, right: left and right,
    BinaryOperator.OR: lambda left, right: left or right,
}
_FUNCTIONS: Mapping[str, Callable[[list[float]], float]] = {
    "abs": lambda numbers: abs(numbers[0]),
    "min": min,
    "max": max,
}


def fold(node: ast.Expression, type_: Type, context: Context) -> Value | None:
    """The value of a node, computed from the values of its operands; None if it is not constant.

    The operations are those of a monitor: IEEE doubles, in the order of the source.
    """
    if isinstance(node, ast.Boolean):
        return Value(type_, boolean=node.value)
    if isinstance(node, ast.Text):
        return Value(type_, text=node.value)
    if isinstance(node, ast.Parenthesized):
        return context.values.get(node.inner)
    if isinstance(type_, Boolean):
        boolean = _boolean(node, context)
        return None if boolean is None else Value(type_, boolean=boolean)
    number = _number(node, type_, context) if isinstance(type_, Quantity) else None
    return None if number is None else Value(type_, (number,))


def _boolean(node: ast.Expression, context: Context) -> bool | None:
    values = [context.values.get(operand) for operand in children(node)]
    known = [value for value in values if value is not None]
    if len(known) < len(values):
        return None
    match node, known:
        case ast.Unary(operator=ast.UnaryOperator.NOT), [Value(boolean=bool(operand))]:
            return not operand
        case ast.Binary(operator=sign), [Value(boolean=bool(left)), Value(boolean=bool(right))]:
            return _JUNCTIONS[sign](left, right)
        case ast.Binary(operator=sign), [Value(text=str(left)), Value(text=str(right))]:
            return _COMPARISONS[sign](left, right)
        case ast.Binary(operator=sign), [Value(numbers=(left,)), Value(numbers=(right,))]:
            return _COMPARISONS[sign](left, right)
        case ast.Membership(is_negated=is_negated), [
            Value(numbers=(number,)),
            Value(numbers=(low, high)),
        ]:
            return (low <= number <= high) is not is_negated
        case _:  # open: a pair
            return None


def record(node: ast.Expression, value: Value, context: Context) -> bool:
    """Record the value of a node. Returns False, after reporting, if the value exceeds the range of
    numbers.
    """
    if not all(map(math.isfinite, value.numbers)):
        context.collector.add(ConstantTooLarge().at(node.span))
        return False
    context.values[node] = value
    return True


def _number(node: ast.Expression, quantity: Quantity, context: Context) -> float | None:
    match node:
        case ast.Number():
            return (quantity.unit or DIMENSIONLESS).to_si(node.value)
        case ast.Unary(operator=ast.UnaryOperator.NEGATE):
            operand = _numbers((node.operand,), context)
            return None if operand is None else -operand[0]
        case ast.Binary():
            sides = _numbers((node.left, node.right), context)
            if sides is None or (node.operator is BinaryOperator.DIVIDE and sides[1] == 0):
                return None
            return _BINARY[node.operator](*sides)
        case ast.Call() if node.function.text in _FUNCTIONS:
            arguments = _numbers(node.arguments, context)
            return None if arguments is None else _FUNCTIONS[node.function.text](arguments)
        case (
            ast.Boolean() | ast.Text() | ast.Bracket() | ast.Reference() | ast.Member()
            | ast.Index() | ast.Sector() | ast.Call() | ast.Edges() | ast.Oscillates()
            | ast.ListFold() | ast.Unary() | ast.Membership() | ast.Held() | ast.Since()
            | ast.Once() | ast.Response() | ast.Doing() | ast.Parenthesized() | ast.Broken()
        ):  # fmt: skip
            return None


def _numbers(nodes: tuple[ast.Expression, ...], context: Context) -> list[float] | None:
    values = [context.values.get(node) for node in nodes]
    numbers = [value.numbers[0] for value in values if value is not None and value.numbers]
    return numbers if len(numbers) == len(nodes) else None
