"""Functions of numbers (S3 to S6) over the reals, including rounding errors.

Terms of the solver are real numbers, but the machine computes with doubles. So the result of a
rounded operation is any number within `|e| * 2^-53 + 2^-200` of the exact value `e`. This bound
holds for every finite double, and small numbers in terms keep the solver fast.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from fractions import Fraction

import z3

from rossmarie.analysis.formulas import Formulas, exactly
from rossmarie.analysis.terms import NumberTerm, constant
from rossmarie.core import AnyFunction, FunctionRow, defined, row
from rossmarie.core.expressions import Operand, Primitive

_LARGEST = constant(sys.float_info.max)
_RELATIVE = Fraction(1, 2**53)
_ABSOLUTE = Fraction(1, 2**200)


def apply(
    function: AnyFunction,
    operands: Sequence[NumberTerm],
    facts: list[z3.BoolRef],
    *,
    rounded: bool,
) -> NumberTerm:
    """The result of a function. Facts about the result are added to `facts`.

    With `rounded`, the result covers all values that doubles can give; otherwise arithmetic is
    exact.
    """
    known = z3.And([operand.known for operand in operands])
    values = [operand.value for operand in operands]
    declared = row(function)
    if declared.bounds is not None:
        # An orientation of zeros, and squares that are too large, give no result.
        known = z3.And(known, z3.FreshBool("finite")) if rounded else known
        return NumberTerm(known, _bounded(declared, values, facts))
    arithmetic = _Arithmetic(facts, rounded=rounded)
    value = Formulas(values, arithmetic.operate).term(defined(function, len(values)))
    return NumberTerm(z3.And(known, *arithmetic.needs), value)


def _bounded(
    declared: FunctionRow, values: Sequence[z3.ArithRef], facts: list[z3.BoolRef]
) -> z3.ArithRef:
    """A free number for the result of a function that the solver cannot compute."""
    assert declared.bounds is not None, "asked before"
    result = z3.FreshReal("number")
    low, high = declared.range
    facts += [result >= constant(low)] if math.isfinite(low) else []
    facts += [result <= constant(high)] if math.isfinite(high) else []
    written = [Operand(index) for index in range(len(values) + 1)]
    formulas = Formulas([*values, result], exactly)
    facts += map(formulas.condition, declared.bounds(written[-1], written[:-1]))
    return result


class _Arithmetic:
    """The operations of one function. The condition `needs` is true where their results are
    known.
    """

    def __init__(self, facts: list[z3.BoolRef], *, rounded: bool) -> None:
        self.needs: list[z3.BoolRef] = []
        self._facts = facts
        self._rounded = rounded

    def operate(self, primitive: Primitive, values: Sequence[z3.ArithRef]) -> z3.ArithRef:
        match primitive:
            case Primitive.NEGATE | Primitive.ABSOLUTE:
                return exactly(primitive, values)
            case Primitive.ADD | Primitive.SUBTRACT | Primitive.MULTIPLY:
                return self._result(exactly(primitive, values))
            case Primitive.DIVIDE:
                self.needs.append(values[1] != 0)
                return self._result(_quotient(values[0], values[1], self._facts))
            case Primitive.SQUARE_ROOT:
                return self._result(exactly(primitive, values))

    def _result(self, exact: z3.ArithRef) -> z3.ArithRef:
        if not self._rounded:
            return exact
        result = _rounded(exact, self._facts)
        self.needs += [result >= -_LARGEST, result <= _LARGEST]
        return result


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


def _value(fraction: Fraction) -> z3.ArithRef:
    return z3.RealVal(str(fraction))
