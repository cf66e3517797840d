"""Functions with roots and angles, and functions of samples: a proof need not know their numbers.

Each has one check of what is known of its result, and a contract that says the same elsewhere.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rossmarie import ir
from rossmarie.core import Function, may_be_infinite, parameters, row
from rossmarie.targets.c99.layout import Layout
from rossmarie.targets.formulas import definition_of, definition_of_samples
from rossmarie.verification.check import Parts


def functions_of(nodes: Iterable[ir.SignalNode]) -> tuple[tuple[Function, int], ...]:
    """The functions with roots and angles: their values matter to no question but their own."""
    applied = {
        (node.function, len(node.operands)): None
        for node in nodes
        if isinstance(node, ir.Apply) and row(node.function).bounds is not None
    }
    return tuple(applied)


def name(function: Function, count: int) -> str:
    """The C function of a function."""
    return definition_of(function, count).name


def _is_possible(function: Function, count: int) -> str:
    """The facts that are known of a result: of an unknown function there are none, and some results
    are never infinite.
    """
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


# --- samples ---------------------------------------------------------------------------------

WINDOW_PARTS: Parts = (
    ("window_middle", "some_middle"),
    ("sample_window", "ignore_sample_window"),
)
"""The functions that keep the samples of windows and put them in order. No question proves these:
they are the same in all machines, and take some thousand comparisons of numbers each time.
"""

_WINDOWS = """\
double some_middle(const monitor *m, unsigned k, unsigned is_upper)
{
    (void)m;
    return __CPROVER_uninterpreted_middle(k, is_upper);
}

void ignore_sample_window(monitor *m, unsigned k, double x, int64_t t_ns)
{
    (void)m;
    (void)k;
    (void)x;
    (void)t_ns;
}
"""


def parts_of_samples(machine: ir.Machine) -> Parts:
    """The functions of samples, where it does not matter which number they give."""
    definitions = map(definition_of_samples, ir.samplings(machine))
    return tuple((each.name, f"any_{each.name}") for each in definitions if not each.is_inline)


def contracts_of_samples(layout: Layout) -> Iterator[str]:
    """The contracts of these functions, and of windows."""
    for definition in map(definition_of_samples, ir.samplings(layout.machine)):
        if definition.is_inline:
            continue
        head = ", ".join(f"double {each}" for each in definition.parameters)
        unused = "".join(f"    (void){each};\n" for each in definition.parameters)
        yield f"double any_{definition.name}({head})\n{{\n{unused}    return nondet_double();\n}}\n"
    if layout.windows:
        yield _WINDOWS
