"""Functions of the core in C."""

from __future__ import annotations

from rossmarie.core.expressions import Primitive, locals_of
from rossmarie.targets.c99.types import number
from rossmarie.targets.formulas import FormulaWriter, FunctionDefinition, Notation

C = Notation(
    number=lambda value: number(value) if value == value else "NAN",
    calls={Primitive.ABSOLUTE: "fabs", Primitive.SQUARE_ROOT: "sqrt"},
    chosen="{0} ? {1} : {2}",
    is_unknown="isnan({0})",
    either="{0} || {1}",
)


def function(definition: FunctionDefinition) -> str:
    """The text of a C function."""
    formulas = FormulaWriter(C, definition.parameters)
    lines = [
        f"const double {local.name} = {formulas.text(local.value)};"
        for local in locals_of(definition.expression)
    ]
    lines.append(f"return {formulas.text(definition.expression)};")
    head = ", ".join(f"double {each}" for each in definition.parameters)
    body = "".join(f"    {line}\n" for line in lines)
    opening = f"/* {definition.remark} */\nstatic inline double {definition.name}({head})\n"
    return f"{opening}{{\n{body}}}\n"
