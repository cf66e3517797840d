"""Functions with roots and angles, and functions of samples, whose values most proofs do not need.

Each has one check of the known facts about its result, and a contract with the same facts for other
checks. The subfunctions have one more check, which proves that the C computes them by the formula
of the core.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from rossmarie.core import (
    AnyFunction,
    SampleNumber,
    Sampling,
    defined,
    may_be_infinite,
    parameters,
    row,
    sampling_row,
)
from rossmarie.core.expressions import Subfunction, applied_in
from rossmarie.ir import model as ir
from rossmarie.verification.check import Check, Parts, WrittenCheck
from rossmarie.verification.formulas import name_of_subfunction
from rossmarie.verification.layout import ProofLayout
from rossmarie.verification.places import function_of, function_of_samples, function_of_subfunction
from rossmarie.verification.supports import samplings

_NOTHING = "the result is unknown if an operand is unknown"


def functions_of(nodes: Iterable[ir.SignalNode]) -> tuple[tuple[AnyFunction, int], ...]:
    """The functions with roots and angles. Only the queries about them need their values."""
    applied = {
        (node.function, len(node.operands)): None
        for node in nodes
        if isinstance(node, ir.Apply) and row(node.function).bounds is not None
    }
    return tuple(applied)


def name(function: AnyFunction, count: int) -> str:
    """The C function of a function."""
    return function_of(function, count)


def _is_possible(function: AnyFunction, count: int) -> str:
    """The known facts about a result. An unknown function has none; some results are never
    infinite.
    """
    known = _known(parameters(count))
    is_finite = not may_be_infinite(function, count, of_infinite=True)
    return f"({known} || isnan(found))" + (" && !isinf(found)" if is_finite else "")


def _known(names: Iterable[str]) -> str:
    return " && ".join(f"!isnan({each})" for each in names)


def contract(function: AnyFunction, count: int) -> str:
    """The contract of a function, for checks to which its value does not matter."""
    names = parameters(count)
    head = ", ".join(f"double {each}" for each in names)
    return (
        f"double any_{name(function, count)}({head})\n{{\n"
        "    const double found = nondet_double();\n"
        f"    __CPROVER_assume({_is_possible(function, count)});\n"
        "    return found;\n}\n"
    )


def kept(function: AnyFunction, count: int) -> str:
    """The obligation that a function keeps its contract."""
    names = parameters(count)
    lines = [f"const double {each} = nondet_double();" for each in names]
    lines.append(f"const double found = {name(function, count)}({', '.join(names)});")
    lines.append(f'__CPROVER_assert({_is_possible(function, count)}, "{_NOTHING}");')
    return "\n".join(f"    {line}" for line in lines)


# --- subfunctions ----------------------------------------------------------------------------


class Subfunctions:
    """The functions that other functions apply: arc sine and arc tangent. In proofs, each is an
    arbitrary function. Its result is unknown if an operand is unknown, and never infinite.
    """

    def __init__(self, functions: Iterable[tuple[AnyFunction, int]]) -> None:
        applied = (each for function in functions for each in applied_in(defined(*function)))
        self._functions = tuple(dict.fromkeys(applied))

    def parts(self) -> Parts:
        """The replacements of subfunctions: the same arbitrary functions in the generated C and in
        the definitions.
        """
        return tuple(
            (name, f"same_{each.name}")
            for each in self._functions
            for name in (function_of_subfunction(each), name_of_subfunction(each))
        )

    def text(self) -> str:
        """The arbitrary functions that replace the subfunctions."""
        return "\n".join(map(_any_function, self._functions))

    def written(self) -> Iterator[WrittenCheck]:
        """The checks of the generated C of the subfunctions."""
        for each in self._functions:
            name, about = function_of_subfunction(each), each.phrase.format(*each.parameters)
            operands = ", ".join(each.parameters)
            found, meant = f"{name}({operands})", f"{name_of_subfunction(each)}({operands})"
            formula = _asked(
                each.parameters, f"spec_same({found}, {meant})", "the result is as defined"
            )
            yield WrittenCheck(Check(name, f"{about}: the formula", is_arithmetic=True), formula)
            is_reported = f"({_known(each.parameters)}) || isnan({found})"
            unknown = _asked(each.parameters, is_reported, _NOTHING)
            yield WrittenCheck(Check(f"{name}_unknown", f"{about}: unknown operands"), unknown)


def _asked(names: Sequence[str], holds: str, about: str) -> str:
    lines = [f"const double {each} = nondet_double();" for each in names]
    lines.append(f'__CPROVER_assert({holds}, "{about}");')
    return "\n".join(f"    {line}" for line in lines)


def _any_function(function: Subfunction) -> str:
    doubles = ", ".join("double" for _ in function.parameters)
    head = ", ".join(f"double {each}" for each in function.parameters)
    call = f"__CPROVER_uninterpreted_{function.name}({', '.join(function.parameters)})"
    return (
        f"double __CPROVER_uninterpreted_{function.name}({doubles});\n"
        f"double same_{function.name}({head})\n{{\n"
        f"    const double found = {call};\n"
        f"    return ({_known(function.parameters)}) && !isinf(found) ? found : NAN;\n}}\n"
    )


# --- samples ---------------------------------------------------------------------------------

_FOUND = {
    SampleNumber.LOWER: ("window_middle", "some_middle"),
    SampleNumber.UPPER: ("window_middle", "some_middle"),
    SampleNumber.TOTAL: ("window_total", "some_total"),
}
"""The functions that search the samples of windows."""

_WINDOWS = """\
double some_middle(const monitor *m, unsigned k, unsigned is_upper)
{
    (void)m;
    return __CPROVER_uninterpreted_middle(k, is_upper);
}

double some_total(const monitor *m, unsigned k)
{
    (void)m;
    return __CPROVER_uninterpreted_total(k);
}

void ignore_sample_window(monitor *m, unsigned k, double x, int64_t t_ns)
{
    (void)m;
    (void)k;
    (void)x;
    (void)t_ns;
}
"""


def parts_of_windows(layout: ProofLayout) -> Parts:
    """The functions that store, sort and add the samples of windows. No query proves these
    functions: they are the same for all machines, and a proof compares some thousand numbers each
    time.
    """
    if not layout.windows:
        return ()
    views = [view for each in samplings(layout.machine) for view in sampling_row(each).views]
    found = dict.fromkeys(_FOUND[view] for view in views if view in _FOUND)
    return (*found, ("sample_window", "ignore_sample_window"))


def parts_of_samples(machine: ir.Machine) -> Parts:
    """The functions of samples, for checks to which their results do not matter."""
    return tuple((name, f"any_{name}") for name in _functions_of_samples(machine).values())


def _functions_of_samples(machine: ir.Machine) -> dict[Sampling, str]:
    """The C names of the functions of samples that have a C function."""
    named = {each: function_of_samples(each) for each in samplings(machine)}
    return {each: name for each, name in named.items() if name is not None}


def contracts_of_samples(layout: ProofLayout) -> Iterator[str]:
    """The contracts of the functions of samples, and of windows."""
    for function, name in _functions_of_samples(layout.machine).items():
        views = [view.value for view in sampling_row(function).views]
        head = ", ".join(f"double {each}" for each in views)
        unused = "".join(f"    (void){each};\n" for each in views)
        yield f"double any_{name}({head})\n{{\n{unused}    return nondet_double();\n}}\n"
    if layout.windows:
        yield _WINDOWS
