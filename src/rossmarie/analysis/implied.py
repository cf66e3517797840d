"""Rules that are active only while another rule is active.

With the same actions, such a rule adds nothing. If both rules need the same resource and the other
rule has priority, this rule never gets the resource.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import z3

from rossmarie.analysis.activity import (
    becomes_active,
    is_cleared,
    propositions_of,
)
from rossmarie.analysis.errors import NeverItsTurn, RuleImplied, WheneverNot
from rossmarie.analysis.finding import Finding, witness_note
from rossmarie.analysis.inquiry import Inquiry, both_active
from rossmarie.analysis.state import ArbitraryState
from rossmarie.ir import Machine

_AT_ONCE = 4
"""The number of candidates in one query."""


def find_implied(inquiry: Inquiry) -> Iterator[Finding]:
    """A warning for each rule that is superfluous, or never gets the resource that it needs."""
    machine = inquiry.machine
    for rule in range(len(machine.rules)):
        candidates = [
            other
            for other in range(len(machine.rules))
            if other != rule
            and not _gives_way(machine, other)
            and (_has_same_actions(machine, rule, other) or _shared(machine, rule, other))
        ]
        for start in range(0, len(candidates), _AT_ONCE):
            needed = _needed(inquiry, rule, candidates[start : start + _AT_ONCE])
            if needed is not None:
                yield from _reported(inquiry, rule, needed)
                break


def _needed(inquiry: Inquiry, rule: int, candidates: Sequence[int]) -> int | None:
    """The first of some rules that must be active whenever a rule is active. None if the rule can
    become active without all of them.
    """
    group = inquiry.about(rule, *candidates)
    others = range(1, len(candidates) + 1)
    if group.is_impossible(partial(_starts_without, rule=0, others=others)):
        return next((other for other in candidates if needs(inquiry, rule, other)), None)
    return None


def _starts_without(state: ArbitraryState, rule: int, others: Sequence[int]) -> z3.BoolRef:
    none = [z3.Not(becomes_active(state, other)) for other in others]
    return z3.And(becomes_active(state, rule), *none)


def needs(inquiry: Inquiry, rule: int, other: int) -> bool:
    """Say whether it is proved that a rule is active only while another rule is active."""
    if any(inquiry.machine.rules[each].release is None for each in (rule, other)):
        return False  # a reset can clear one of them at any time
    machine = inquiry.machine
    one, two = machine.rules[rule], machine.rules[other]
    if not machine.rules[rule].inputs:
        return False
    if (one.condition, one.release) == (two.condition, two.release):
        return True
    pair = inquiry.about(rule, other)
    return pair.is_impossible(partial(_starts_without, rule=0, others=(1,))) and pair.is_impossible(
        partial(_is_left, rule=0, other=1)
    )


def _is_left(state: ArbitraryState, rule: int, other: int) -> z3.BoolRef:
    return z3.And(is_cleared(state, other), z3.Not(is_cleared(state, rule)))


def _gives_way(machine: Machine, rule: int) -> bool:
    """Say whether a rule may be active although its plan is not carried out."""
    return bool(machine.reactions.plans) and bool(machine.reactions.plans[rule].unless)


def _has_same_actions(machine: Machine, rule: int, other: int) -> bool:
    """Say whether two rules have the same actions."""
    return (
        machine.rules[rule].actions == machine.rules[other].actions
        and len(machine.rules[rule].actions) > 0
    )


def _shared(machine: Machine, rule: int, other: int) -> str | None:
    """The name of a resource that a rule needs, and that a rule with priority needs for other
    actions. None if there is none.
    """
    reactions = machine.reactions
    if not reactions.plans or reactions.order.index(other) > reactions.order.index(rule):
        return None
    theirs = {reactions.tasks[task].resource for task in reactions.plans[other].tasks}
    for task in reactions.plans[rule].tasks:
        resource = reactions.tasks[task].resource
        if resource is not None and resource in theirs:
            return reactions.resources[resource]
    return None


def _reported(inquiry: Inquiry, rule: int, other: int) -> Iterator[Finding]:
    machine = inquiry.machine
    one, two = machine.rules[rule], machine.rules[other]
    is_same = _has_same_actions(machine, rule, other)
    if is_same and rule < other and needs(inquiry, other, rule):
        return  # reported for the later rule
    pair = inquiry.about(rule, other)
    witness = pair.witness(both_active(pair.machine))
    propositions = propositions_of(pair.machine, (0, 1))
    notes = () if witness is None else (witness_note(pair.machine, witness, propositions),)
    place = WheneverNot(active=two.name, rule=one.name).at(two.head)
    resource = _shared(machine, rule, other)
    if is_same:
        finding = RuleImplied(rule=one.name, other=two.name)
        yield Finding(finding.at(one.head, place, notes=notes), witness)
    elif resource is not None:
        turn = NeverItsTurn(rule=one.name, other=two.name, resource=resource)
        yield Finding(turn.at(one.head, place, notes=notes), witness)
