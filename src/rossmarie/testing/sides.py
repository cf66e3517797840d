"""Values beside a threshold, as formulas for z3."""

from __future__ import annotations

from collections.abc import Iterator

import z3

from rossmarie import ir
from rossmarie.analysis.terms import constant
from rossmarie.testing.goals import ComparisonEdge
from rossmarie.units import parse_unit

_BETWEEN = 1e-3  # of a step: a value nearer to a whole number is rounded to it


def beside(
    machine: ir.Machine, edge: ComparisonEdge, term: z3.ArithRef, side: int
) -> Iterator[z3.BoolRef]:
    """Formulas that a term is at a threshold (`side` is 0), just under it (-1) or just over it (1).
    The first satisfiable formula is the best.
    """
    threshold = constant(edge.threshold)
    if side == 0:
        yield term == threshold
        return
    distance = (term - threshold) * side
    if edge.is_whole:
        yield z3.And(is_apart(edge, distance), distance <= constant(edge.step * (1 + _BETWEEN)))
        yield is_apart(edge, distance)
    else:
        yield term == constant(_point(machine, edge, side))
        yield distance > 0


def is_apart(edge: ComparisonEdge, distance: z3.ArithRef) -> z3.BoolRef:
    """A formula: a value on one side of a threshold differs from the threshold."""
    return distance >= constant(edge.step * _BETWEEN) if edge.is_whole else distance > 0


def _point(machine: ir.Machine, edge: ComparisonEdge, steps: int) -> float:
    """The round number that lies some steps beside a threshold, in SI."""
    unit = parse_unit(machine.signals[edge.constant].unit or "1")
    shown = unit.from_si(edge.threshold)
    step = edge.step / unit.scale
    return unit.to_si(float(f"{shown + steps * step:.12g}"))
