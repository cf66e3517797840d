"""Functions of numbers (rules S3 to S6), computed as the core defines them.

Python's floats are IEEE binary64 and round like C's doubles. If C returns an infinity or NaN where
Python raises an exception, this module returns the result of C.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import cache

from rossmarie.core import AnyFunction, Sampling, defined, sampling_row
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
    Subfunction,
    locals_of,
)

NAN = math.nan

_Values = Sequence[float]
"""The operands, followed by the named numbers computed so far."""


def apply(function: AnyFunction, operands: tuple[float, ...]) -> float:
    """The value of a function; NaN if it is not finite (S4)."""
    return finite_or_nan(plain(function, operands))


def plain(function: AnyFunction, operands: tuple[float, ...]) -> float:
    """The value of the expression of a function, before S4."""
    return _program(function, len(operands))(operands)


def of_samples(function: Sampling, views: tuple[float, ...]) -> float:
    """The value of a function of samples, from the function's views of them (S4, S8)."""
    value = _sampling_program(function)(views)
    return value if sampling_row(function).keeps_infinities else finite_or_nan(value)


def finite_or_nan(value: float) -> float:
    """The number, or NaN if the number is not finite (S4)."""
    return value if math.isfinite(value) else NAN


@cache
def _program(function: AnyFunction, count: int) -> Callable[[_Values], float]:
    return _program_of(defined(function, count), count)


@cache
def program(function: Subfunction) -> Callable[[_Values], float]:
    """The computation of a subfunction from its operands."""
    return _program_of(function.expression, len(function.parameters))


@cache
def _sampling_program(function: Sampling) -> Callable[[_Values], float]:
    declared = sampling_row(function)
    return _program_of(declared.expression, len(declared.views))


def _program_of(expression: Expression, count: int) -> Callable[[_Values], float]:
    named = locals_of(expression)
    places = {local: count + place for place, local in enumerate(named)}
    steps = [_compiled(local.value, places) for local in named]
    result = _compiled(expression, places)
    if not steps:
        return result

    def run(operands: _Values) -> float:
        values = list(operands)
        for step in steps:
            values.append(step(values))
        return result(values)

    return run


def _compiled(expression: Expression, places: Mapping[Local, int]) -> Callable[[_Values], float]:
    match expression:
        case ConstantNumber(value=number):
            return lambda _: number
        case Operand(index=index):
            return lambda values: values[index]
        case Local():
            place = places[expression]
            return lambda values: values[place]
        case Computed(primitive=primitive, operands=operands):
            parts = [_compiled(operand, places) for operand in operands]
            operation = PRIMITIVES[primitive]
            return lambda values: operation(*[part(values) for part in parts])
        case Applied(function=function, operands=operands):
            parts = [_compiled(operand, places) for operand in operands]
            applied = program(function)
            return lambda values: applied([part(values) for part in parts])
        case Chosen(condition=condition, then=then, otherwise=otherwise):
            holds = _condition(condition, places)
            one, other = _compiled(then, places), _compiled(otherwise, places)
            return lambda values: one(values) if holds(values) else other(values)


def _condition(condition: Condition, places: Mapping[Local, int]) -> Callable[[_Values], bool]:
    match condition:
        case IsLess(left=left, right=right):
            one, other = _compiled(left, places), _compiled(right, places)
            return lambda values: one(values) < other(values)
        case IsEqual(left=left, right=right):
            one, other = _compiled(left, places), _compiled(right, places)
            return lambda values: one(values) == other(values)
        case IsUnknown(operand=operand):
            number = _compiled(operand, places)
            return lambda values: math.isnan(number(values))
        case Either(left=first, right=second):
            is_first, is_second = _condition(first, places), _condition(second, places)
            return lambda values: is_first(values) or is_second(values)


def _quotient(a: float, b: float) -> float:
    if b != 0.0:
        return a / b
    return NAN if a == 0.0 or math.isnan(a) else math.copysign(math.inf, a) * math.copysign(1, b)


def _root(x: float) -> float:
    return math.sqrt(x) if x >= 0.0 else NAN


PRIMITIVES: Mapping[Primitive, Callable[..., float]] = {
    Primitive.ADD: lambda a, b: a + b,
    Primitive.SUBTRACT: lambda a, b: a - b,
    Primitive.MULTIPLY: lambda a, b: a * b,
    Primitive.DIVIDE: _quotient,
    Primitive.NEGATE: lambda a: -a,
    Primitive.ABSOLUTE: abs,
    Primitive.SQUARE_ROOT: _root,
}
