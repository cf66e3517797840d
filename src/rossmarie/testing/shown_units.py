"""Units in which the values of tests are written."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from rossmarie import ir
from rossmarie.testing.goals import ComparisonEdge, edges
from rossmarie.units import Unit, parse_unit


def unit_of_field(machine: ir.Machine, kind: str, index: int) -> Unit:
    """The unit of a variable of the solver, by the variable's kind and index."""
    own = ""
    if kind == "slot":
        own = machine.slots[index].unit
    elif kind == "element":
        own = machine.arrays[index].unit
    elif kind == "angle":
        own = "deg"
    elif kind in ("rate", "previous"):
        own = machine.signals[index].unit
    return parse_unit(own or "1")


def unit_of_edge(
    machine: ir.Machine,
    propositions: Iterable[int],
    own: Unit,
    reads: Callable[[ComparisonEdge], bool],
) -> Unit | None:
    """The unit of the first threshold that `reads` accepts, if its dimension is that of `own`; None
    if there is none.
    """
    for proposition in propositions:
        for edge in edges(machine, proposition):
            written = parse_unit(machine.signals[edge.constant].unit or "1")
            if written.dimension == own.dimension and reads(edge):
                return written
    return None
