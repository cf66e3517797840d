"""The loss of an input, and the rules that become active because of the loss."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import z3

from rossmarie.analysis.activity import becomes_active
from rossmarie.analysis.errors import LossUnnoticed
from rossmarie.analysis.finding import Finding
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.loss import Effect, Loss
from rossmarie.analysis.state import ArbitraryState
from rossmarie.ir import AgeReaches, Machine, reachable_propositions, supports


def losses(inquiry: Inquiry) -> Iterator[Loss]:
    """The loss of each input on its own: its channel falls silent after its first messages."""
    machine = inquiry.machine
    for index, declared in enumerate(machine.inputs):
        ages = [declared.timeout_ns] if declared.timeout_ns is not None else []
        ages += _ages(machine, index)
        if ages:
            after_ns = max(ages)
            yield Loss(index, after_ns, dict(_effects(inquiry, index, after_ns)))
        else:
            yield Loss(index, None, {})


def _effects(inquiry: Inquiry, used: int, after_ns: int) -> Iterator[tuple[int, Effect]]:
    """The rules that the loss of an input affects, and the effect on each."""
    for index, rule in enumerate(inquiry.machine.rules):
        if used in rule.inputs:
            effect = _effect(inquiry, used, after_ns, index)
            if effect is not Effect.NOTHING:
                yield index, effect


def _ages(machine: Machine, used: int) -> Iterator[int]:
    """The ages of an input that rules compare."""
    for rule in machine.rules:
        for proposition in reachable_propositions(machine, rule.condition):
            node = machine.propositions[proposition].node
            if isinstance(node, AgeReaches) and node.input == used:
                yield node.age_ns


def _effect(whole: Inquiry, used: int, after_ns: int, index: int) -> Effect:
    inquiry, rule = whole.about(index), 0
    stale = partial(_is_stale, used=used, after_ns=after_ns)
    if inquiry.is_impossible(
        lambda state: z3.And(stale(state), z3.Not(becomes_active(state, rule))), settled=True
    ):
        return Effect.ACTIVATES
    if inquiry.is_impossible(
        lambda state: z3.And(
            stale(state), becomes_active(state, rule), _others_work(state, used, rule)
        ),
        settled=True,
    ):
        # An effect that also needs the loss of another input is reported for that other input.
        return Effect.NOTHING
    return Effect.DEPENDS


def _is_stale(state: ArbitraryState, used: int, after_ns: int) -> z3.BoolRef:
    channel = state.machine.inputs[used].channel
    return z3.And(state.has_arrived(channel), state.age(channel) >= after_ns)


def _others_work(state: ArbitraryState, used: int, rule: int) -> z3.BoolRef:
    """The fact that all other inputs of a rule are fresh, and all their numbers are known."""
    machine = state.machine
    channel = machine.inputs[used].channel
    others = [i for i in machine.rules[rule].inputs if machine.inputs[i].channel != channel]
    support = state.asked.supports.propositions[machine.rules[rule].condition]
    known = [
        state.slot(slot).known for slot in support.slots if machine.slots[slot].input in others
    ]
    return z3.And([state.is_fresh(other) for other in others] + known)


def find_unnoticed(inquiry: Inquiry) -> Iterator[Finding]:
    """A warning for each input with a timeout whose loss activates no rule."""
    machine = inquiry.machine
    rests_on = supports(machine).propositions
    roots = {root for rule in machine.rules for root in rule.roots}
    in_rules = {used for root in roots for used in rests_on[root].inputs}
    for index, declared in enumerate(machine.inputs):
        if declared.timeout_ns is None or index not in in_rules:
            # the input is never stale, or it only confirms effects, and unknown values confirm
            # nothing
            continue
        after_ns = max([declared.timeout_ns, *_ages(machine, index)])
        if next(_effects(inquiry, index, after_ns), None) is None:
            yield Finding(LossUnnoticed(input=declared.name).at(declared.span))
