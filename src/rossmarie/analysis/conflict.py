"""Rules that can be active together and need the same resource, without a priority between them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from dslkit.diagnostics import Remark
from rossmarie.analysis.activity import propositions_of
from rossmarie.analysis.errors import (
    ConflictOrdered,
    NameRules,
    NeedsItToo,
    NeverTogether,
    OrderRules,
    RulesConflict,
    Undecided,
)
from rossmarie.analysis.finding import Finding, witness_note
from rossmarie.analysis.inquiry import Inquiry, both_active
from rossmarie.analysis.solver import Satisfiability
from rossmarie.ir import Machine, overruled

Needs = Mapping[int, frozenset[int]]
"""The needs of a rule: each resource, with the indices of the actions that need it."""


def find_conflicts(inquiry: Inquiry, *, thorough: bool) -> Iterator[Finding]:
    """A warning for each rule that conflicts with an earlier rule, once for each resource.

    With `thorough`, all pairs are queried, and proofs and priorities are also reported.
    """
    machine = inquiry.machine
    needs = [_needs(machine, rule) for rule in range(len(machine.rules))]
    ordered = ordered_pairs(machine)
    reported: set[tuple[int, int]] = set()
    for second, needed in enumerate(needs):
        for resource, actions in needed.items():
            for first in range(second):
                if needs[first].get(resource, actions) == actions or (first, second) in reported:
                    continue
                if _do_the_same(machine, first, second, resource):
                    continue
                is_ordered = (first, second) in ordered or (second, first) in ordered
                if is_ordered and not thorough:
                    continue
                reported.add((first, second))
                found = _judged(inquiry, first, second, resource, ordered)
                is_conflict = isinstance(found, Finding) and found.diagnostic.code == "ROSS700"
                if thorough or found.diagnostic.code in ("ROSS700", "ROSS729"):
                    yield found
                if is_conflict and not thorough:
                    break


def _needs(machine: Machine, rule: int) -> Needs:
    found: dict[int, set[int]] = {}
    if machine.reactions.plans:
        for index in machine.reactions.plans[rule].tasks:
            task = machine.reactions.tasks[index]
            if task.resource is not None:
                found.setdefault(task.resource, set()).add(task.action)
    return {resource: frozenset(actions) for resource, actions in found.items()}


def _do_the_same(machine: Machine, first: int, second: int, resource: int) -> bool:
    """Say whether both rules do the same thing with a resource, whichever actions they use. In this
    case the owner of the resource does not matter.
    """
    done = overruled.only_deed(machine.reactions, first, resource)
    return done is not None and done == overruled.only_deed(machine.reactions, second, resource)


def ordered_pairs(machine: Machine) -> set[tuple[int, int]]:
    """The pairs of rules in which the first has priority over the second, directly or through other
    rules, or in which the second gives way to the first.
    """
    below: dict[int, set[int]] = {rule: set() for rule in range(len(machine.rules))}
    for rule in reversed(machine.reactions.order):
        for first, second in machine.reactions.priorities:
            if first == rule:
                below[rule] |= {second} | below[second]
    plans = enumerate(machine.reactions.plans)
    giving_way = {(other, rule) for rule, plan in plans for other in plan.unless}
    return {(first, second) for first, seconds in below.items() for second in seconds} | giving_way


def _judged(
    inquiry: Inquiry, first: int, second: int, resource: int, ordered: set[tuple[int, int]]
) -> Finding:
    machine = inquiry.machine
    rules = (machine.rules[first], machine.rules[second])
    needed = machine.reactions.resources[resource]
    pair = inquiry.about(first, second)
    result = pair.decide(both_active(pair.machine))
    names = (rules[0].name, rules[1].name)
    place = NeedsItToo().at(rules[0].head)
    span = rules[1].head
    if result.outcome is Satisfiability.IMPOSSIBLE:
        never = NeverTogether(first=names[0], second=names[1], resource=needed)
        return Finding(never.at(span, place))
    notes: tuple[Remark, ...] = ()
    if result.witness is not None:
        propositions = propositions_of(pair.machine, (0, 1))
        notes = (witness_note(pair.machine, result.witness, propositions),)
    if (first, second) in ordered or (second, first) in ordered:
        upper = names if (first, second) in ordered else names[::-1]
        known = "they can be active together" if notes else "it is undecided if both can be active"
        order = ConflictOrdered(first=upper[0], second=upper[1], resource=needed, together=known)
        return Finding(order.at(span, place, notes=notes), result.witness)
    if result.witness is None:
        query = f"can rules `{names[0]}` and `{names[1]}`, which both need {needed}, be active"
        open_one = Undecided(query=f"{query} together?", reason="no order between them")
        return Finding(open_one.at(span, place, help=_advice(machine, first, second)))
    finding = RulesConflict(first=names[0], second=names[1], resource=needed)
    help = _advice(machine, first, second)
    return Finding(finding.at(span, place, notes=notes, help=help), result.witness)


def _advice(machine: Machine, first: int, second: int) -> Remark:
    rules = (machine.rules[first], machine.rules[second])
    if any(rule.head.text != rule.name for rule in rules):
        return NameRules()
    return OrderRules(first=rules[0].name, second=rules[1].name)
