"""Expressions of the core in exact numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction

from rossmarie.core.expressions import (
    Applied,
    Chosen,
    Computed,
    Condition,
    ConstantNumber,
    Either,
    Expression,
    IsEqual,
    IsLess,
    IsUnknown,
    Local,
    Operand,
    Primitive,
)


def value(expression: Expression, operands: list[Fraction]) -> Fraction:
    """An expression in exact numbers."""
    match expression:
        case ConstantNumber(value=number):
            return Fraction(number)
        case Operand(index=index):
            return operands[index]
        case Local(value=inner):
            return value(inner, operands)
        case Chosen(condition=condition, then=then, otherwise=otherwise):
            return value(then if holds(condition, operands) else otherwise, operands)
        case Computed(primitive=primitive, operands=parts):
            return EXACT[primitive](*(value(part, operands) for part in parts))
        case Applied(function=function, operands=parts):
            return value(function.expression, [value(part, operands) for part in parts])


EXACT: Mapping[Primitive, Callable[..., Fraction]] = {
    Primitive.ADD: lambda a, b: a + b,
    Primitive.SUBTRACT: lambda a, b: a - b,
    Primitive.MULTIPLY: lambda a, b: a * b,
    Primitive.NEGATE: lambda a: -a,
    Primitive.ABSOLUTE: abs,
}


def holds(condition: Condition, operands: list[Fraction]) -> bool:
    """A condition on exact numbers."""
    match condition:
        case IsLess(left=left, right=right):
            return value(left, operands) < value(right, operands)
        case IsEqual(left=left, right=right):
            return value(left, operands) == value(right, operands)
        case IsUnknown():
            return False
        case Either(left=one, right=other):
            return holds(one, operands) or holds(other, operands)
