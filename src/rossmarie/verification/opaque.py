"""Functions with roots and angles, of which a proof need not know which number they give.

Each has one check of what is known of its result, and a contract that says the same elsewhere.
"""

from __future__ import annotations

from collections.abc import Iterable

from rossmarie import ir
from rossmarie.core import Function, may_be_infinite, parameters, row
from rossmarie.targets.c99.functions import name


def functions_of(nodes: Iterable[ir.SignalNode]) -> tuple[tuple[Function, int], ...]:
    """The functions with roots and angles: their values matter to no question but their own."""
    applied = {
        (node.function, len(node.operands)): None
        for node in nodes
        if isinstance(node, ir.Apply) and row(node.function).bounds is not None
    }
    return tuple(applied)


def _is_possible(function: Function, count: int) -> str:
    """What is known of a result: of what is not known nothing is, and some are never infinite."""
    known = " && ".join(f"!isnan({each})" for each in parameters(count))
    is_finite = not may_be_infinite(function, count, of_infinite=True)
    return f"({known} || isnan(found))" + (" && !isinf(found)" if is_finite else "")


def contract(function: Function, count: int) -> str:
    """The contract of a function where it does not matter which number it gives."""
    names = parameters(count)
    head = ", ".join(f"double {each}" for each in names)
    return (
        f"double any_{name(function, count)}({head})\n{{\n"
        "    const double found = nondet_double();\n"
        f"    __CPROVER_assume({_is_possible(function, count)});\n"
        "    return found;\n}\n"
    )


def kept(function: Function, count: int) -> str:
    """That a function keeps its contract."""
    names = parameters(count)
    lines = [f"const double {each} = nondet_double();" for each in names]
    lines.append(f"const double found = {name(function, count)}({', '.join(names)});")
    claim = '"nothing is known of what is not"'
    lines.append(f"__CPROVER_assert({_is_possible(function, count)}, {claim});")
    return "\n".join(f"    {line}" for line in lines)
