"""Activity of rules, as predicates over one state, over a trace, and over the evaluations of a
trace.
"""

from __future__ import annotations

import z3

from rossmarie.analysis.state import ArbitraryState
from rossmarie.analysis.terms import NO
from rossmarie.analysis.trace import SymbolicTrace
from rossmarie.ir import Machine


def propositions_of(machine: Machine, rules: tuple[int, ...]) -> tuple[int, ...]:
    """The propositions that some rules depend on: conditions and releases."""
    found = [machine.rules[rule].condition for rule in rules]
    found += [release for rule in rules if (release := machine.rules[rule].release) is not None]
    return tuple(dict.fromkeys(found))


def becomes_active(state: ArbitraryState, rule: int) -> z3.BoolRef:
    """Say whether an inactive rule becomes active (S35)."""
    return state.proposition(state.machine.rules[rule].condition).activates


def may_be_active(state: ArbitraryState, rule: int) -> z3.BoolRef:
    """Say whether a rule can be active after the evaluation, that is, not cleared (S36 to S38)."""
    return z3.Not(is_cleared(state, rule))


def is_cleared(state: ArbitraryState, rule: int) -> z3.BoolRef:
    """Say whether an active rule is cleared by the evaluation; resets are ignored."""
    declared = state.machine.rules[rule]
    if declared.release is None:
        return NO
    return z3.And(
        state.proposition(declared.condition).false, state.proposition(declared.release).true
    )


def together(state: ArbitraryState, one: int, other: int) -> z3.BoolRef:
    """Say whether two rules can both be active now, if at most one was active before."""
    return z3.Or(
        z3.And(becomes_active(state, one), may_be_active(state, other)),
        z3.And(becomes_active(state, other), may_be_active(state, one)),
    )


def seen_together(trace: SymbolicTrace, one: int, other: int) -> z3.BoolRef:
    """Say whether two rules are active at one moment of a trace."""
    return z3.Or(
        [
            z3.And(trace.is_active(one, moment), trace.is_active(other, moment))
            for moment in range(len(trace.moments))
        ]
    )
