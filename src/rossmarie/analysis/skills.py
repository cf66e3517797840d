"""The facts that hold between answers of the skills in one message.

Each question is a slot of its own. No message answers two in a way that contradicts itself: who
pushes a fragile thing pushes, and nobody who does not push has a thing that is pushed.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping

import z3

from rossmarie import ir
from rossmarie.analysis.terms import Number
from rossmarie.ir.skills import implies

Fresh = Callable[[int], z3.BoolRef]
"""Say whether the input of a slot has not timed out."""


def questions(machine: ir.Machine, channel: int) -> dict[int, ir.Doing]:
    """The slots of a channel that ask which skills run, with what they ask."""
    asked = ((index, slot.path, slot.input) for index, slot in enumerate(machine.slots))
    return {
        index: path[0]
        for index, path, used in asked
        if machine.inputs[used].channel == channel and path and isinstance(path[0], ir.Doing)
    }


def is_quantity(machine: ir.Machine, slot: int) -> bool:
    """Say whether a slot is a number that only a skill that runs has."""
    return any(isinstance(step, ir.Quantity) for step in machine.slots[slot].path)


def message_facts(
    machine: ir.Machine, numbers: Mapping[int, Number], fresh: Fresh
) -> list[z3.BoolRef]:
    """Say what slots of one message, by index, have to do with each other."""
    return [
        fact
        for one, other in itertools.permutations(numbers, 2)
        if _channel(machine, one) == _channel(machine, other)
        for fact in _facts(machine, (one, numbers[one]), (other, numbers[other]), fresh)
    ]


def _facts(
    machine: ir.Machine, first: tuple[int, Number], second: tuple[int, Number], fresh: Fresh
) -> Iterator[z3.BoolRef]:
    (one, given), (other, found) = first, second
    match (machine.slots[one].path, machine.slots[other].path):
        case ((ir.Doing() as step,), (ir.Doing() as asked,)) if implies(step, asked):
            yield z3.Implies(given.value == 1, found.value == 1)
            if step == asked:
                yield z3.Implies(z3.And(given.known, fresh(other)), found.known)
        case ((ir.Doing(arguments=()) as step,), (ir.Quantity() as asked,)):
            if set(asked.skills) <= set(step.skills):
                yield z3.Implies(z3.And(given.known, given.value == 0), z3.Not(found.known))
        case _:  # open: fields, which have nothing to do with each other
            pass


def _channel(machine: ir.Machine, slot: int) -> int:
    return machine.inputs[machine.slots[slot].input].channel
