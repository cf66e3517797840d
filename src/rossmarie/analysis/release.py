"""Rules that are never cleared once they are active."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import z3

from rossmarie.analysis.activity import is_cleared, propositions_of
from rossmarie.analysis.errors import NoWayOut, Undecided
from rossmarie.analysis.finding import Finding
from rossmarie.analysis.inquiry import AskedQuery, Inquiry
from rossmarie.analysis.solver import Satisfiability
from rossmarie.analysis.state import ArbitraryState
from rossmarie.analysis.trace import SymbolicTrace
from rossmarie.analysis.witness import View
from rossmarie.ir import TruthValue


def find_never_cleared(inquiry: Inquiry) -> Iterator[Finding]:
    """A warning for each rule that nothing clears although its condition could become false."""
    machine = inquiry.machine
    for index, rule in enumerate(machine.rules):
        if rule.release is None or not rule.inputs:
            continue
        alone = inquiry.about(index)
        condition = alone.machine.rules[0].condition
        if alone.is_impossible(partial(_is_false, condition=condition)):
            continue  # always active; another query reports this
        result = alone.decide(
            AskedQuery(
                propositions_of(alone.machine, (0,)),
                partial(is_cleared, rule=0),
                partial(_clears, rule=0),
                partial(_is_seen_to_clear, rule=0),
            )
        )
        span = rule.head
        if result.outcome is Satisfiability.IMPOSSIBLE:
            yield Finding(NoWayOut(rule=rule.name).at(span))
        elif result.outcome is Satisfiability.UNDECIDED:
            query = f"can rule `{rule.name}` be cleared once it is active?"
            reason = "no short trace shows it, and no proof excludes it"
            yield Finding(Undecided(query=query, reason=reason).at(span))


def _is_false(state: ArbitraryState, condition: int) -> z3.BoolRef:
    return state.proposition(condition).is_value(TruthValue.FALSE)


def _clears(trace: SymbolicTrace, rule: int) -> z3.BoolRef:
    moments = range(1, len(trace.moments))
    return z3.Or(
        [
            z3.And(trace.is_active(rule, moment - 1), z3.Not(trace.is_active(rule, moment)))
            for moment in moments
        ]
    )


def _is_seen_to_clear(seen: Sequence[View], rule: int) -> bool:
    return len(seen) > 1 and seen[-2].active[rule] and not seen[-1].active[rule]
