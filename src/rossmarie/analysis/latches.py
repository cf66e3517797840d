"""Latched rules that another rule releases: the effect `reset` of a rule replaces the operator's
reset.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import z3

from dslkit.diagnostics import Remark
from rossmarie.analysis.activity import becomes_active, may_be_active, propositions_of
from rossmarie.analysis.conflict import ordered_pairs
from rossmarie.analysis.errors import LatchReleased, Undecided
from rossmarie.analysis.finding import Finding, witness_note
from rossmarie.analysis.inquiry import AskedQuery, Inquiry, QueryResult
from rossmarie.analysis.solver import Satisfiability
from rossmarie.analysis.state import ArbitraryState
from rossmarie.analysis.trace import SymbolicTrace
from rossmarie.analysis.witness import View
from rossmarie.ir import Machine, TruthValue
from rossmarie.ir.reactions import Reset, timeout_ns

RESETTING, LATCHED = 0, 1
"""The two rules in the queried part of a machine. The rules after `unless` follow."""


def find_released_latches(inquiry: Inquiry) -> Iterator[Finding]:
    """A warning for each latched rule that another rule resets, or that resets itself. A user marks
    the reset as intended with a priority: `priority RESETTING over LATCHED`.
    """
    machine = inquiry.machine
    meant = ordered_pairs(machine)
    for rule, plan in enumerate(machine.reactions.plans):
        resets = [task for task in plan.tasks if _resets(machine, task)]
        for latched, declared in enumerate(machine.rules):
            is_open = declared.release is None and (rule, latched) not in meant
            if resets and is_open and latched not in plan.unless:
                yield from _judged(inquiry, rule, latched, resets)


def _resets(machine: Machine, task: int) -> bool:
    return isinstance(machine.reactions.tasks[task].effect, Reset)


def _judged(inquiry: Inquiry, rule: int, latched: int, resets: Sequence[int]) -> Iterator[Finding]:
    """Judge a latch by the first task that releases it: report the release, or that the query is
    undecided.
    """
    machine = inquiry.machine
    part = inquiry.about(rule, latched, *machine.reactions.plans[rule].unless)
    undecided: Finding | None = None
    for task in resets:
        result = part.decide(Release(part.machine, _is_at_once(machine, rule, task)).asked)
        if result.outcome is Satisfiability.POSSIBLE:
            yield _released(machine, rule, latched, task, result)
            return
        if result.outcome is Satisfiability.UNDECIDED:
            undecided = undecided or _open(machine, rule, latched)
    if undecided is not None:
        yield undecided


def _is_at_once(machine: Machine, rule: int, task: int) -> bool:
    """Say whether a task starts at the instant at which its rule is engaged: it is no escalation,
    and no earlier task is awaited (R4, R5).
    """
    tasks = machine.reactions.tasks
    for stage in machine.reactions.plans[rule].stages:
        if task in stage:
            return True
        if any(timeout_ns(tasks[each].effect) is not None for each in stage):
            return False
    return False


# --- the predicate -------------------------------------------------------------------------------


@dataclass(frozen=True)
class Release:
    """Predicate: a reset comes while the latched rule is active and its condition is false (S38).
    `is_at_once` is True if the reset comes at the instant at which its rule is engaged, and False
    if it comes later.
    """

    part: Machine
    is_at_once: bool

    @property
    def asked(self) -> AskedQuery:
        """The predicate as a query."""
        propositions = propositions_of(self.part, tuple(range(len(self.part.rules))))
        return AskedQuery(propositions, self.in_state, self._in_trace, self.in_view)

    @property
    def _condition(self) -> int:
        return self.part.rules[LATCHED].condition

    @property
    def _unless(self) -> range:
        return range(LATCHED + 1, len(self.part.rules))

    def in_state(self, state: ArbitraryState) -> z3.BoolRef:
        """Say whether the predicate is true in a state; before the state, the latched rule may have
        been active.
        """
        is_start = self.is_at_once and not self._unless
        engaged = (becomes_active if is_start else may_be_active)(state, RESETTING)
        in_the_way = [becomes_active(state, other) for other in self._unless]
        return z3.And(engaged, z3.Not(z3.Or(in_the_way)), state.proposition(self._condition).false)

    def _in_trace(self, trace: SymbolicTrace) -> z3.BoolRef:
        return z3.Or([self._at(trace, moment) for moment in range(1, len(trace.moments))])

    def _at(self, trace: SymbolicTrace, moment: int) -> z3.BoolRef:
        engaged = partial(_is_engaged, trace, self._unless)
        before = engaged(moment - 1) if self.is_at_once else z3.BoolVal(False)
        is_over = trace.moments[moment].proposition(self._condition).false
        return z3.And(engaged(moment), z3.Not(before), trace.is_active(LATCHED, moment), is_over)

    def in_view(self, seen: Sequence[View]) -> bool:
        """Say whether the predicate is true at the last of some evaluations."""
        now = seen[-1]
        is_over = now.active[LATCHED] and now.truth_values[self._condition] is TruthValue.FALSE
        if not is_over or not self._is_seen_engaged(now):
            return False
        return not self.is_at_once or (len(seen) > 1 and not self._is_seen_engaged(seen[-2]))

    def _is_seen_engaged(self, view: View) -> bool:
        return view.active[RESETTING] and not any(view.active[other] for other in self._unless)


def _is_engaged(trace: SymbolicTrace, unless: Sequence[int], moment: int) -> z3.BoolRef:
    """R1: say whether the resetting rule is engaged."""
    in_the_way = [trace.is_active(other, moment) for other in unless]
    return z3.And(trace.is_active(RESETTING, moment), z3.Not(z3.Or(in_the_way)))


# --- words -----------------------------------------------------------------------------------


def _released(machine: Machine, rule: int, latched: int, task: int, result: QueryResult) -> Finding:
    one, two = machine.rules[rule], machine.rules[latched]
    action = machine.reactions.tasks[task].action
    finding = LatchReleased(
        rule=one.name,
        latched="its own latch" if rule == latched else f"the latched rule `{two.name}`",
        action=machine.reactions.actions[action].name,
    )
    assert result.witness is not None
    conditions = tuple(dict.fromkeys((two.condition, one.condition)))
    note = witness_note(machine, result.witness, conditions)
    places = () if rule == latched else (finding.Latched().at(two.head),)
    help = _advice(machine, rule, latched)
    return Finding(finding.at(one.head, *places, notes=(note,), help=help), result.witness)


def _advice(machine: Machine, rule: int, latched: int) -> Remark:
    one, two = machine.rules[rule], machine.rules[latched]
    if rule == latched:
        return LatchReleased.OwnLatch()
    if any(each.head.text != each.name for each in (one, two)):
        return LatchReleased.NameRules()
    return LatchReleased.GiveWay(rule=one.name, latched=two.name)


def _open(machine: Machine, rule: int, latched: int) -> Finding:
    one, two = machine.rules[rule], machine.rules[latched]
    query = f"can rule `{one.name}` reset the latched rule `{two.name}`?"
    reason = "no short trace shows it, and no proof excludes it"
    return Finding(Undecided(query=query, reason=reason).at(one.head))
