"""Functions of numbers in C: a plain operation in its place, everything else as a C function."""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie.core import Function, defined, parameters, row
from rossmarie.core.expressions import Primitive, locals_of
from rossmarie.targets.c99.types import number
from rossmarie.targets.formulas import Dialect, Formulas, is_plain

_C = Dialect(
    number=lambda value: number(value) if value == value else "NAN",
    calls={
        Primitive.ABSOLUTE: "fabs",
        Primitive.SQUARE_ROOT: "sqrt",
        Primitive.ARC_SINE: "asin",
        Primitive.ARC_TANGENT: "atan2",
    },
    chosen="{0} ? {1} : {2}",
    is_unknown="isnan({0})",
    either="{0} || {1}",
)


def name(function: Function, count: int) -> str:
    """The C function of a function of `count` operands."""
    own = f"{function.value}_of"
    return own if row(function).most is not None else f"{own}_{count}"


def call(function: Function, operands: Sequence[str]) -> str:
    """The function of operands that are atoms of C, before S4."""
    count = len(operands)
    if is_plain(function, count):
        return Formulas(_C, operands).text(defined(function, count))
    return f"{name(function, count)}({', '.join(operands)})"


def definition(function: Function, count: int) -> str:
    """The C function that `call` calls."""
    names = parameters(count)
    expression = defined(function, count)
    formulas = Formulas(_C, names)
    remark = row(function).worded(names)
    lines = [
        f"const double {local.name} = {formulas.text(local.value)};"
        for local in locals_of(expression)
    ]
    lines.append(f"return {formulas.text(expression)};")
    head = ", ".join(f"double {each}" for each in names)
    body = "".join(f"    {line}\n" for line in lines)
    return (
        f"/* {remark[0].upper()}{remark[1:]}. */\n"
        f"static double {name(function, count)}({head})\n{{\n{body}}}\n"
    )
