"""Functions of the core in Python."""

from __future__ import annotations

from rossmarie.core.expressions import Primitive, locals_of
from rossmarie.targets.formulas import FormulaWriter, FunctionDefinition, Notation

PYTHON = Notation(
    number=lambda value: repr(value) if value == value else "NAN",
    calls={
        Primitive.DIVIDE: "divide",
        Primitive.ABSOLUTE: "abs",
        Primitive.SQUARE_ROOT: "square_root",
    },
    chosen="{1} if {0} else {2}",
    is_unknown="{0} != {0}",
    either="{0} or {1}",
)


def function(definition: FunctionDefinition) -> str:
    """The text of a Python function."""
    formulas = FormulaWriter(PYTHON, definition.parameters)
    head = ", ".join(f"{each}: float" for each in definition.parameters)
    lines = [
        f"def {definition.name}({head}) -> float:",
        f'    """{definition.remark}"""',
        *(
            f"    {local.name} = {formulas.text(local.value)}"
            for local in locals_of(definition.expression)
        ),
        f"    return {formulas.text(definition.expression)}",
    ]
    return "\n".join(lines) + "\n"
