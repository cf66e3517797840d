"""Checks that guards make superfluous.

The input is a layout. A number inside its guard is finite, so a scalar that only guards use need
not be checked on arrival. A guarded number that never arrived, or expired, is outside its guard, so
the state of its input needs no separate check.
"""

from __future__ import annotations

from rossmarie import ir
from rossmarie.targets.c99.layout import CLayout


def covered_values(layout: CLayout) -> frozenset[int]:
    """Values that may be stored as received while all guards of their channel are satisfied:
    guarded scalars, and their absolute and negated values, if no other value is computed from them.
    """
    machine = layout.machine
    looked_at = _looked_at_freely(layout)
    guarded = {guard.value for guard in layout.guards}
    users: dict[int, list[int]] = {}
    for index, signal in enumerate(machine.signals):
        for operand in ir.signal_operands(signal.node):
            if operand in layout.value_of_signal:
                users.setdefault(layout.value_of_signal[operand], []).append(index)
    found: set[int] = set()
    for slot_value in layout.value_of_slot:
        mirrors = users.get(slot_value, [])
        values = [layout.value_of_signal.get(mirror, -1) for mirror in mirrors]
        are_mirrors = all(_is_mirror(machine, mirror) for mirror in mirrors)
        are_last = all(value in guarded and value not in users for value in values)
        family = {slot_value, *values}
        is_watched = slot_value in guarded or values
        if is_watched and are_mirrors and are_last and not family & looked_at:
            found |= family
    return frozenset(found)


def is_seen_by_guards(layout: CLayout, channel: int) -> bool:
    """Say whether every input of a channel has a guarded number of its own, and no age of an input
    is used.
    """
    seen: set[int] = set()
    for guard in layout.guards:
        support = layout.values[guard.value].support
        seen |= {layout.machine.slots[slot].input for slot in support.slots}
    inputs = {i for i, used in enumerate(layout.machine.inputs) if used.channel == channel}
    return inputs <= seen and not inputs & layout.aged_inputs()


def _is_mirror(machine: ir.Machine, signal: int) -> bool:
    node = machine.signals[signal].node
    mirrors = (ir.Function.NEGATE, ir.Function.ABSOLUTE)
    return isinstance(node, ir.Apply) and node.function in mirrors


def _looked_at_freely(layout: CLayout) -> set[int]:
    """The values that tests, oscillations and elements use without a guard."""
    propositions = [*layout.value_of_test, *layout.oscillations]
    nodes = [layout.machine.propositions[proposition].node for proposition in propositions]
    signals = {signal for node in nodes for signal in ir.compared_signals(node)}
    signals |= ir.made_beside(layout.machine)
    return {layout.value_of_signal[s] for s in signals if s in layout.value_of_signal}
