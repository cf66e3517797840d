"""Functions with roots and angles, and functions of samples: a proof need not know their numbers.

Each has one check of what is known of its result, and a contract that says the same elsewhere.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rossmarie.core import Function, Sampling, may_be_infinite, parameters, row, sampling_row
from rossmarie.ir import model as ir
from rossmarie.verification.check import Parts
from rossmarie.verification.layout import Layout
from rossmarie.verification.places import function_of, function_of_samples
from rossmarie.verification.supports import samplings


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
    return function_of(function, count)


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
    return tuple((name, f"any_{name}") for name in _functions_of_samples(machine).values())


def _functions_of_samples(machine: ir.Machine) -> dict[Sampling, str]:
    """Their names in C, of those that have one."""
    named = {each: function_of_samples(each) for each in samplings(machine)}
    return {each: name for each, name in named.items() if name is not None}


def contracts_of_samples(layout: Layout) -> Iterator[str]:
    """The contracts of these functions, and of windows."""
    for function, name in _functions_of_samples(layout.machine).items():
        views = [view.value for view in sampling_row(function).views]
        head = ", ".join(f"double {each}" for each in views)
        unused = "".join(f"    (void){each};\n" for each in views)
        yield f"double any_{name}({head})\n{{\n{unused}    return nondet_double();\n}}\n"
    if layout.windows:
        yield _WINDOWS
