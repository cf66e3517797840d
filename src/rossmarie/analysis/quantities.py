"""Facts about numbers that belong to a running skill: if no skill runs, there is no number."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import z3

from rossmarie import ir
from rossmarie.analysis.terms import NumberTerm


def is_quantity(machine: ir.Machine, slot: int) -> bool:
    """Say whether a slot contains a number that exists only while a skill runs."""
    return any(isinstance(step, ir.Quantity) for step in machine.slots[slot].path)


def quantity_facts(machine: ir.Machine, numbers: Mapping[int, NumberTerm]) -> Iterator[z3.BoolRef]:
    """Facts: a quantity in a message is unknown if no skill runs that may have the quantity.
    `numbers` are the numbers of some slots.
    """
    for asked, doing in numbers.items():
        for slot, found in numbers.items():
            if _channel(machine, asked) == _channel(machine, slot) and _covers(
                machine, asked, slot
            ):
                none_runs = z3.And(doing.known, doing.value == 0)
                yield z3.Implies(none_runs, z3.Not(found.known))


def _covers(machine: ir.Machine, asked: int, slot: int) -> bool:
    """Say whether a slot contains the query about all skills that may have the quantity in another
    slot.
    """
    match (machine.slots[asked].path, machine.slots[slot].path):
        case ((ir.Doing(arguments=(), is_ahead=False) as step,), (ir.Quantity() as quantity,)):
            return set(quantity.skills) <= set(step.skills)
        case _:  # open: any other slots
            return False


def _channel(machine: ir.Machine, slot: int) -> int:
    return machine.inputs[machine.slots[slot].input].channel
