"""Hints for the solver, so that the interpreter can confirm a trace of events and a reader can
follow it.
"""

from __future__ import annotations

from collections.abc import Sequence

import z3

from rossmarie import ir
from rossmarie.analysis.formulas import Formulas, exactly
from rossmarie.analysis.terms import within
from rossmarie.analysis.trace import SymbolicTrace
from rossmarie.core import row
from rossmarie.core.expressions import Operand

_APART = z3.RealVal("0.001")
"""The least difference between compared numbers, in their common unit, that survives rounding."""


def hints(trace: SymbolicTrace) -> list[list[z3.BoolRef]]:
    """Facts that make a proposed trace likely to be confirmed and easy to read, from many to none.

    A length or a distance is easy to compute. Compared numbers are apart, because floats are
    rounded. Numbers are near the constants that they are compared with, and are not negative.
    """
    lengths = []
    near = []
    norms, ranges = sorted(_lengths(trace)), _near(trace)
    for moment in trace.moments:
        for index in norms:
            node = trace.asked.machine.signals[index].node
            assert isinstance(node, ir.Apply)
            parts = [moment.signal(operand).value for operand in node.operands]
            lengths.append(_is_easy(node.function, parts, moment.signal(index).value))
        for index, (low, high) in ranges.items():
            value = moment.signal(index).value
            near += within(value, (low, high))
    apart = _apart(trace)
    return [
        *([[*lengths, *apart, *near], apart] if apart else ()),
        [*lengths, *near],
        *([lengths] if lengths else ()),
        [],
    ]


def _apart(trace: SymbolicTrace) -> list[z3.BoolRef]:
    """Facts: signals that are compared with one another, not with a constant, are not nearly
    equal.
    """
    machine = trace.asked.machine
    found = []
    for proposition in trace.times.propositions:
        node = machine.propositions[proposition].node
        if trace.asked.elements.propositions[proposition] is not None or not isinstance(
            node, ir.Compare
        ):
            continue
        sides = (node.left, node.right)
        if any(isinstance(machine.signals[side].node, ir.Constant) for side in sides):
            continue
        for moment in trace.moments:
            left, right = (moment.signal(side).value for side in sides)
            found.append(z3.Or(left - right > _APART, right - left > _APART))
    return found


def _near(trace: SymbolicTrace) -> dict[int, tuple[float, float]]:
    """The range of numbers around the constants that each signal is compared with."""
    machine = trace.asked.machine
    limits: dict[int, list[float]] = {}
    for proposition in trace.times.propositions:
        if trace.asked.elements.propositions[proposition] is not None:
            continue
        compared = ir.compared_signals(machine.propositions[proposition].node)
        nodes = [machine.signals[signal].node for signal in compared]
        values = [node.value for node in nodes if isinstance(node, ir.Constant)]
        for signal, node in zip(compared, nodes, strict=True):
            if values and not isinstance(node, ir.Constant):
                limits.setdefault(signal, []).extend(values)
    return {
        signal: (
            min(0.0, *(value - abs(value) / 2 for value in values)) if max(values) <= 0 else 0.0,
            max(1.0 if max(values) <= 0 else 0.0, *(value + abs(value) / 2 for value in values)),
        )
        for signal, values in limits.items()
    }


def _lengths(trace: SymbolicTrace) -> set[int]:
    """The requested functions that are easy to compute in some cases: lengths and distances."""
    machine = trace.asked.machine
    waiting = [
        signal
        for proposition in trace.times.propositions
        for signal in ir.compared_signals(machine.propositions[proposition].node)
    ]
    found: set[int] = set()
    while waiting:
        index = waiting.pop()
        node = machine.signals[index].node
        if trace.asked.elements.signals[index] is None:
            waiting += ir.signal_operands(node)
            if isinstance(node, ir.Apply) and row(node.function).easy is not None:
                found.add(index)
    return found


def _is_easy(
    function: ir.AnyFunction, operands: Sequence[z3.ArithRef], result: z3.ArithRef
) -> z3.BoolRef:
    """The fact that a function is in an easy case, and has this result."""
    easy, formulas = row(function).easy, Formulas(operands, exactly)
    assert easy is not None, "asked before"
    return z3.Or(
        [
            z3.And(*map(formulas.condition, case.conditions), formulas.term(case.value) == result)
            for case in easy(tuple(map(Operand, range(len(operands)))))
        ]
    )
