"""The functions of numbers that a machine calls. Targets define only these functions."""

from __future__ import annotations

from rossmarie.core import AnyFunction, Function, Sampling
from rossmarie.ir import model as ir


def functions(machine: ir.Machine) -> tuple[tuple[AnyFunction, int], ...]:
    """The functions that signals apply, with their numbers of operands, in the order of the
    core.
    """
    found = set()
    for signal in machine.signals:
        match signal.node:
            case ir.Apply(function=function, operands=operands):
                found.add((function, len(operands)))
            case ir.Fold(folding=folding):
                found.add((folding.function, 2))
            case (
                ir.Constant() | ir.Read() | ir.Sampled() | ir.Element() | ir.Count()
            ):  # fmt: skip
                pass
    order = [each.value for each in Function]
    regional = sorted({each.value for each, _ in found} - set(order))
    order += regional
    return tuple(sorted(found, key=lambda each: (order.index(each[0].value), each[1])))


def samplings(machine: ir.Machine) -> tuple[Sampling, ...]:
    """The functions of samples that signals use, in the order of the core."""
    nodes = (signal.node for signal in machine.signals)
    found = {node.function for node in nodes if isinstance(node, ir.Sampled)}
    return tuple(each for each in Sampling if each in found)
