"""Predicates for z3 about states of the machine in which a skill is known to run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import z3

from rossmarie import ir
from rossmarie.analysis.activity import becomes_active
from rossmarie.analysis.encoding import Encoding
from rossmarie.analysis.state import ArbitraryState
from rossmarie.analysis.terms import YES


def runs(state: Encoding, skill: str) -> z3.BoolRef:
    """The fact that the context is known and that a skill runs. Other skills may run at the same
    time.
    """
    asked = queries(state.machine)
    yes = {
        slot: skill in step.skills and not step.arguments and not step.is_ahead
        for slot, step in asked.items()
    }
    return z3.And(YES, *tells(state, {slot: answer or None for slot, answer in yes.items()}))


def stands_still(state: Encoding, skill: str) -> z3.BoolRef:
    """The fact that the context is known, and that neither this skill nor another skill of the same
    query runs.
    """
    asked = queries(state.machine)
    no = {
        slot: False if skill in step.skills and not step.is_ahead else None
        for slot, step in asked.items()
    }
    return z3.And(YES, *tells(state, no))


def acts(state: ArbitraryState, *rules: int) -> z3.BoolRef:
    """The fact that one of these rules becomes active, if none was active before."""
    return z3.Or([becomes_active(state, rule) for rule in rules])


def tells(state: Encoding, answers: Mapping[int, bool | None]) -> Iterator[z3.BoolRef]:
    """The facts that the context is known and that the queries in all slots have these answers.
    None stands for any answer.
    """
    for slot, answer in answers.items():
        number = state.slot(slot)
        yield number.known
        if answer is not None:
            yield number.value == (1 if answer else 0)
    contexts = {state.machine.slots[slot].input for slot in answers}
    for index, proposition in enumerate(state.machine.propositions):
        if isinstance(proposition.node, ir.AgeReaches) and proposition.node.input in contexts:
            yield state.proposition(index).false


def queries(machine: ir.Machine) -> dict[int, ir.Doing]:
    """The slots with queries about running skills, and the query of each."""
    found = {}
    for index, slot in enumerate(machine.slots):
        step = slot.path[0] if slot.path else None
        if isinstance(step, ir.Doing):
            found[index] = step
    return found


def asked_by(machine: ir.Machine, rule: int) -> tuple[ir.Doing, ...]:
    """The queries of the condition of a rule to the skills that run, each once."""
    asked, found = queries(machine), dict[ir.Doing, None]()
    for proposition in ir.reachable_propositions(machine, machine.rules[rule].condition):
        node = machine.propositions[proposition].node
        if isinstance(node, ir.Flag):
            signal = machine.signals[node.signal].node
            if isinstance(signal, ir.Read) and signal.slot in asked:
                found[asked[signal.slot]] = None
    return tuple(found)


def rests_on_skills(machine: ir.Machine, rule: ir.Rule) -> bool:
    """Say whether a rule depends on the skills that run or can start: in its condition, or in its
    release.
    """
    inputs = machine.inputs
    heard = {
        inputs[slot.input].channel
        for slot in machine.slots
        if any(isinstance(step, ir.Doing | ir.Quantity) for step in slot.path)
    }
    propositions = ir.supports(machine).propositions
    return any(heard & ir.all_channels(machine, propositions[root]) for root in rule.roots)
