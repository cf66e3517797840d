"""Functions of numbers in Python: a plain operation in its place, else a function of the module."""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie.core import Function, defined, parameters, row
from rossmarie.core.expressions import Primitive, locals_of
from rossmarie.targets.formulas import Dialect, Formulas, is_plain

_PYTHON = Dialect(
    number=lambda value: repr(value) if value == value else "NAN",
    calls={
        Primitive.DIVIDE: "divide",
        Primitive.ABSOLUTE: "abs",
        Primitive.SQUARE_ROOT: "square_root",
        Primitive.ARC_SINE: "arc_sine",
        Primitive.ARC_TANGENT: "math.atan2",
    },
    chosen="{1} if {0} else {2}",
    is_unknown="{0} != {0}",
    either="{0} or {1}",
)


def name(function: Function, count: int) -> str:
    """The Python function of a function of `count` operands."""
    own = f"{function.value}_of"
    return own if row(function).most is not None else f"{own}_{count}"


def call(function: Function, operands: Sequence[str]) -> str:
    """The function of operands that are atoms of Python, before S4."""
    count = len(operands)
    if is_plain(function, count):
        return Formulas(_PYTHON, operands).text(defined(function, count))
    return f"{name(function, count)}({', '.join(operands)})"


def definition(function: Function, count: int) -> str:
    """The Python function that `call` calls."""
    names = parameters(count)
    expression = defined(function, count)
    formulas = Formulas(_PYTHON, names)
    remark = row(function).worded(names)
    lines = [
        f"def {name(function, count)}({', '.join(f'{each}: float' for each in names)}) -> float:",
        f'    """{remark[0].upper()}{remark[1:]}."""',
        *(f"    {local.name} = {formulas.text(local.value)}" for local in locals_of(expression)),
        f"    return {formulas.text(expression)}",
    ]
    return "\n".join(lines) + "\n"
