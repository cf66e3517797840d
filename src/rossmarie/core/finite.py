"""Infinities, as far as the expression of a function alone determines them.

Results that are not finite are unknown (S4), and numbers outside arrays are finite or unknown. So
most operands need no test. Targets use this module to find the operands that need one.
"""

from __future__ import annotations

import math
from functools import cache

from rossmarie.core.expressions import (
    Applied,
    Chosen,
    Computed,
    ConstantNumber,
    Expression,
    Local,
    Operand,
    Primitive,
    Subfunction,
)
from rossmarie.core.functions import AnyFunction, defined, row


@cache
def may_be_infinite(function: AnyFunction, count: int, *, of_infinite: bool) -> bool:
    """Say whether the expression of a function of `count` operands can be infinite. The operands
    are finite or NaN; with `of_infinite`, they can also be infinite.
    """
    if all(map(math.isfinite, row(function).range)):
        return False
    return _may_be_infinite(defined(function, count), of_infinite)


def _may_be_infinite(expression: Expression, of_infinite: bool) -> bool:
    match expression:
        case ConstantNumber(value=value):
            return value in (float("inf"), float("-inf"))
        case Operand():
            return of_infinite
        case Local(value=value):
            return _may_be_infinite(value, of_infinite)
        case Chosen(then=then, otherwise=otherwise):
            return any(_may_be_infinite(each, of_infinite) for each in (then, otherwise))
        case Computed(primitive=primitive, operands=operands):
            match primitive:
                case Primitive.ADD | Primitive.SUBTRACT | Primitive.MULTIPLY | Primitive.DIVIDE:
                    return True
                case Primitive.NEGATE | Primitive.ABSOLUTE | Primitive.SQUARE_ROOT:
                    return _may_be_infinite(operands[0], of_infinite)
        case Applied(function=function, operands=operands):
            is_infinite = any(_may_be_infinite(each, of_infinite) for each in operands)
            return _may_be_infinite(function.expression, is_infinite)


@cache
def rounds(function: AnyFunction, count: int) -> bool:
    """Say whether a function computes and therefore rounds, instead of choosing among its
    operands.
    """
    return _rounds(defined(function, count))


def _rounds(expression: Expression) -> bool:
    match expression:
        case ConstantNumber() | Operand():
            return False
        case Local(value=value):
            return _rounds(value)
        case Chosen(then=then, otherwise=otherwise):
            return _rounds(then) or _rounds(otherwise)
        case Computed(primitive=Primitive.NEGATE | Primitive.ABSOLUTE, operands=operands):
            return _rounds(operands[0])
        case Computed() | Applied():
            return True


@cache
def shown_by(function: AnyFunction, count: int) -> frozenset[int]:
    """The operands that are finite whenever the expression of a function is finite."""
    return _shown_by(defined(function, count))


def _shown_by(expression: Expression) -> frozenset[int]:
    match expression:
        case ConstantNumber():
            return frozenset()
        case Operand(index=index):
            return frozenset({index})
        case Local(value=value):
            return _shown_by(value)
        case Chosen(then=then, otherwise=otherwise):
            return _shown_by(then) & _shown_by(otherwise)
        case Computed(primitive=primitive, operands=operands):
            match primitive:
                case Primitive.ADD | Primitive.SUBTRACT | Primitive.MULTIPLY:
                    return _shown_by(operands[0]) | _shown_by(operands[1])
                case (
                    Primitive.NEGATE | Primitive.ABSOLUTE | Primitive.SQUARE_ROOT | Primitive.DIVIDE
                ):
                    return _shown_by(operands[0])  # a number divided by infinity is 0
        case Applied(function=function, operands=operands):
            shown = _shown_by_subfunction(function)
            return frozenset().union(*(_shown_by(operands[index]) for index in shown))


@cache
def _shown_by_subfunction(function: Subfunction) -> frozenset[int]:
    return _shown_by(function.expression)
