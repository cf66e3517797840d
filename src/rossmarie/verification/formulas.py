"""Expressions of the core as C, written for comparison with the semantics: each operation in its
own parentheses, each number exact to the last bit.

The generator of the proved C has its own writer and shares no code with this module.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from rossmarie.core import AnyFunction, Sampling, defined, parameters, row, sampling_row
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
    subfunctions_of,
)


def name(function: AnyFunction, count: int) -> str:
    """The C function that defines a function of `count` operands."""
    return f"spec_{function.value}_{count}"


def definition(function: AnyFunction, count: int) -> str:
    """The C definition of a function of `count` operands, before S4 applies."""
    names = parameters(count)
    remark = f"{row(function).rule}: {row(function).worded(names)}"
    return _definition(name(function, count), names, defined(function, count), remark)


def subfunctions(applied: Iterable[tuple[AnyFunction, int]]) -> tuple[Subfunction, ...]:
    """The subfunctions that these functions apply. Each follows the subfunctions that it
    applies.
    """
    return tuple(dict.fromkeys(each for one in applied for each in subfunctions_of(defined(*one))))


def name_of_subfunction(function: Subfunction) -> str:
    """The C function that defines a subfunction."""
    return f"spec_{function.name}"


def definition_of_subfunction(function: Subfunction) -> str:
    """The C definition of a subfunction."""
    remark = f"S5: {function.phrase.format(*function.parameters)}"
    name = name_of_subfunction(function)
    return _definition(name, function.parameters, function.expression, remark)


def name_of_samples(function: Sampling) -> str:
    """The C function that defines a function of samples."""
    return f"spec_{function.value}"


def definition_of_samples(function: Sampling) -> str:
    """The C definition of a function of samples, before S4 applies."""
    declared = sampling_row(function)
    names = [view.value for view in declared.views]
    time = "a window" if declared.has_window else "a time"
    remark = f"{declared.rule}: {declared.worded('a number', time)}"
    return _definition(name_of_samples(function), names, declared.expression, remark)


def _definition(name: str, names: Sequence[str], expression: Expression, remark: str) -> str:
    head = ", ".join(f"double {each}" for each in names)
    steps = [
        f"    const double {local.name} = {_text(local.value, names)};\n"
        for local in locals_of(expression)
    ]
    return (
        f"/* {remark}. */\nstatic double {name}({head})\n"
        f"{{\n{''.join(steps)}    return {_text(expression, names)};\n}}\n"
    )


def literal(value: float) -> str:
    """A number in C, exactly."""
    if math.isnan(value):
        return "NAN"
    if math.isinf(value):
        return "INFINITY" if value > 0 else "(-INFINITY)"
    return f"({value.hex()})"


def _text(expression: Expression, names: Sequence[str]) -> str:
    match expression:
        case ConstantNumber(value=value):
            return literal(value)
        case Operand(index=index):
            return names[index]
        case Local(name=name):
            return name
        case Computed(primitive=primitive, operands=operands):
            return _operation(primitive, [_text(operand, names) for operand in operands])
        case Applied(function=function, operands=operands):
            applied = ", ".join(_text(operand, names) for operand in operands)
            return f"{name_of_subfunction(function)}({applied})"
        case Chosen(condition=condition, then=then, otherwise=otherwise):
            holds = _condition(condition, names)
            return f"({holds} ? {_text(then, names)} : {_text(otherwise, names)})"


def _operation(primitive: Primitive, parts: Sequence[str]) -> str:
    match primitive:
        case Primitive.ADD:
            return f"({parts[0]} + {parts[1]})"
        case Primitive.SUBTRACT:
            return f"({parts[0]} - {parts[1]})"
        case Primitive.MULTIPLY:
            return f"({parts[0]} * {parts[1]})"
        case Primitive.DIVIDE:
            return f"({parts[0]} / {parts[1]})"
        case Primitive.NEGATE:
            return f"(-{parts[0]})"
        case Primitive.ABSOLUTE:
            return f"fabs({parts[0]})"
        case Primitive.SQUARE_ROOT:
            return f"sqrt({parts[0]})"


def _condition(condition: Condition, names: Sequence[str]) -> str:
    match condition:
        case IsLess(left=left, right=right):
            return f"{_text(left, names)} < {_text(right, names)}"
        case IsEqual(left=left, right=right):
            return f"{_text(left, names)} == {_text(right, names)}"
        case IsUnknown(operand=operand):
            return f"isnan({_text(operand, names)})"
        case Either(left=one, right=other):
            return f"({_condition(one, names)} || {_condition(other, names)})"
