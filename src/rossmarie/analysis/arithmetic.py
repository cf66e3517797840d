"""Functions of numbers (S3 to S6) over the reals, with what rounding can add.

Terms of the solver are real numbers, the machine computes with doubles. So the result of a function
that rounds is not its exact value `e` but any number within `|e| * 2^-53 + 2^-200` of it: that
holds of every finite double, and small numbers in terms keep the solver fast.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Literal

import z3

from rossmarie.analysis.terms import Number, constant
from rossmarie.ir import Function

LARGEST = constant(sys.float_info.max)
_RELATIVE = Fraction(1, 2**53)
_ABSOLUTE = Fraction(1, 2**200)
_Rounding = Literal[Function.ADD, Function.SUBTRACT, Function.MULTIPLY, Function.DIVIDE]
_LARGEST_ANGLE = {
    Function.PITCH: math.pi / 2,  # the double that `asin(1)` is
    Function.ROLL: math.pi,
    Function.YAW: math.pi,
}
_SLACK = Fraction(1, 2**40)
"""More than the roundings in a norm of thousands of numbers can add."""


def apply(
    function: Function,
    operands: Sequence[Number],
    facts: list[z3.BoolRef],
    *,
    rounded: bool,
) -> Number:
    """The result of a function; what holds of it goes to `facts`.

    With `rounded` it covers all that doubles can give; without, exact arithmetic.
    """
    known = z3.And([operand.known for operand in operands])
    values = [operand.value for operand in operands]
    match function:
        case Function.ROLL | Function.PITCH | Function.YAW | Function.NORM:
            # Of an orientation of zeros, and where squares are too large, nothing comes out.
            known = z3.And(known, z3.FreshBool("finite")) if rounded else known
            measure = _norm if function is Function.NORM else _angle
            return Number(known, measure(function, values, facts))
        case Function.NEGATE | Function.ABSOLUTE | Function.MINIMUM | Function.MAXIMUM:
            return Number(known, _EXACT[function](*values))
        case Function.ADD | Function.SUBTRACT | Function.MULTIPLY | Function.DIVIDE:
            return _arithmetic(function, known, values, facts, rounded=rounded)


def _arithmetic(
    function: _Rounding,
    known: z3.BoolRef,
    values: Sequence[z3.ArithRef],
    facts: list[z3.BoolRef],
    *,
    rounded: bool,
) -> Number:
    if function is Function.DIVIDE:
        known = z3.And(known, values[1] != 0)
    exact = _exact(function, values, facts)
    if not rounded:
        return Number(known, exact)
    result = _rounded(exact, facts)
    return Number(z3.And(known, result >= -LARGEST, result <= LARGEST), result)


def _exact(
    function: _Rounding, values: Sequence[z3.ArithRef], facts: list[z3.BoolRef]
) -> z3.ArithRef:
    left, right = values
    match function:
        case Function.ADD:
            return left + right
        case Function.SUBTRACT:
            return left - right
        case Function.MULTIPLY:
            return left * right
        case Function.DIVIDE:
            return _quotient(left, right, facts)


def _quotient(left: z3.ArithRef, right: z3.ArithRef, facts: list[z3.BoolRef]) -> z3.ArithRef:
    if z3.is_rational_value(right):
        return left / right if right.as_fraction() != 0 else left
    quotient = z3.FreshReal("number")
    facts.append(z3.Implies(right != 0, quotient * right == left))
    return quotient


def _rounded(exact: z3.ArithRef, facts: list[z3.BoolRef]) -> z3.ArithRef:
    result = z3.FreshReal("number")
    low, high = (_value(1 - _RELATIVE), _value(1 + _RELATIVE))
    least = _value(_ABSOLUTE)
    facts.append(
        z3.If(
            exact >= 0,
            z3.And(exact * low - least <= result, result <= exact * high + least),
            z3.And(exact * high - least <= result, result <= exact * low + least),
        )
    )
    return result


def _angle(function: Function, _: Sequence[z3.ArithRef], facts: list[z3.BoolRef]) -> z3.ArithRef:
    """Any angle: how the three hang together with the quaternion is left open."""
    angle = z3.FreshReal("number")
    largest = constant(_LARGEST_ANGLE[function])
    facts.append(z3.And(angle >= -largest, angle <= largest))
    return angle


def _norm(_: Function, values: Sequence[z3.ArithRef], facts: list[z3.BoolRef]) -> z3.ArithRef:
    """A length between its greatest component and the sum of all; below 2^-500, where squares
    are lost, it may be less.
    """
    norm = z3.FreshReal("number")
    sizes = [absolute(value) for value in values]
    tiny = _value(Fraction(1, 2**500))
    facts.append(norm >= 0)
    facts += [norm >= size * _value(1 - _SLACK) - tiny for size in sizes]
    facts.append(norm <= z3.Sum(sizes) * _value(1 + _SLACK) + tiny)
    return norm


def absolute(value: z3.ArithRef) -> z3.ArithRef:
    """Without its sign."""
    return z3.If(value >= 0, value, -value)


def _value(fraction: Fraction) -> z3.ArithRef:
    return z3.RealVal(str(fraction))


_EXACT: Mapping[Function, Callable[..., z3.ArithRef]] = {
    Function.NEGATE: lambda a: -a,
    Function.ABSOLUTE: absolute,
    Function.MINIMUM: lambda a, b: z3.If(a < b, a, b),
    Function.MAXIMUM: lambda a, b: z3.If(a > b, a, b),
}
