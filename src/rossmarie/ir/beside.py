"""The numbers beside elements (S74): numbers of slots and constants that are used together with the
elements of an array or of a list.

The input is a machine whose operands precede their users.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from rossmarie.ir import model as ir
from rossmarie.ir.support import compared_signals, element_arrays, signal_operands


def stand_beside(machine: ir.Machine) -> tuple[bool, ...]:
    """For each signal, whether it may be used beside elements. Only functions of slots and
    constants may, because their values are known before elements are evaluated.
    """
    found: list[bool] = []
    for signal in machine.signals:
        match signal.node:
            case ir.Constant() | ir.Read():
                found.append(True)
            case ir.Apply(operands=operands):
                found.append(all(found[operand] for operand in operands))
            case ir.Sampled() | ir.Element() | ir.Fold() | ir.Count():
                found.append(False)
    return tuple(found)


def beside(machine: ir.Machine) -> Mapping[int, tuple[int, ...]]:
    """The signals beside the elements of each array, without constants, in index order. A list has
    one entry, for its first column. Arrays without such signals are left out.
    """
    arrays = element_arrays(machine)
    found: dict[int, set[int]] = {}

    def take(array: int | None, signals: Iterable[int]) -> None:
        for signal in signals:
            is_constant = isinstance(machine.signals[signal].node, ir.Constant)
            if array is not None and arrays.signals[signal] is None and not is_constant:
                found.setdefault(array, set()).add(signal)

    for index, each in enumerate(machine.signals):
        take(arrays.signals[index], signal_operands(each.node))
    for index, proposition in enumerate(machine.propositions):
        take(arrays.propositions[index], compared_signals(proposition.node))
    return {array: tuple(sorted(signals)) for array, signals in sorted(found.items())}


def made_beside(machine: ir.Machine) -> frozenset[int]:
    """The signals beside elements, and all their operands."""
    waiting = [signal for signals in beside(machine).values() for signal in signals]
    found: set[int] = set()
    while waiting:
        signal = waiting.pop()
        if signal not in found:
            found.add(signal)
            waiting += signal_operands(machine.signals[signal].node)
    return frozenset(found)
