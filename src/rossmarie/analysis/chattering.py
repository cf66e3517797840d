"""Rules that can toggle fast, because noise moves a number back and forth across a threshold."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import z3

from rossmarie.analysis.activity import propositions_of
from rossmarie.analysis.errors import Chattering
from rossmarie.analysis.finding import Finding, witness_note
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.trace import SymbolicTrace
from rossmarie.analysis.witness import View
from rossmarie.ir import Machine
from rossmarie.ir.duration_text import duration_text

SECOND = 1_000_000_000
_LEGS = 4
"""The legs of a trace: a beginning, then active, cleared, active again."""


def find_chattering(inquiry: Inquiry, within_ns: int) -> Iterator[Finding]:
    """A warning for each rule that can be shown to become active twice within a given time.

    Rules whose contract needs time (`clear for`) or a reset are skipped, and so are rules that
    stand for an exemption, which have no contract.
    """
    machine = inquiry.machine
    for index, rule in enumerate(machine.rules):
        if (
            rule.exempts is not None
            or rule.release is None
            or not rule.inputs
            or not _is_simple(machine, rule.release)
        ):
            continue
        alone = inquiry.about(index)
        predicate = partial(_toggles, rule=0, within_ns=within_ns)
        witness = alone.quick_witness(
            propositions_of(alone.machine, (0,)), _LEGS, partial(_alternates, rule=0), predicate
        )
        if witness is not None:
            condition = alone.machine.rules[0].condition
            note = witness_note(alone.machine, witness, (condition,))
            finding = Chattering(
                rule=rule.name,
                within=duration_text(within_ns),
                found=duration_text(witness.end_ns),
            )
            yield Finding(finding.at(rule.head, notes=(note,)), witness)


def _is_simple(machine: Machine, release: int) -> bool:
    return machine.propositions[release].text == "true"


def _alternates(trace: SymbolicTrace, rule: int) -> z3.BoolRef:
    """The condition at the first message of each leg: true, false, true, false or the opposite."""
    condition = trace.asked.machine.rules[rule].condition
    firsts = [moment.proposition(condition) for moment in trace.moments[::2]]
    return z3.And(
        [fact.false if number % 2 == 0 else fact.true for number, fact in enumerate(firsts)]
    )


def _toggles(seen: Sequence[View], rule: int, within_ns: int) -> bool:
    """Return True if a rule became active twice within a time, the second time just now."""
    starts = [
        view.at_ns
        for view, before in zip(seen[1:], seen, strict=False)
        if view.active[rule] and not before.active[rule]
    ]
    is_now = len(seen) > 1 and seen[-1].active[rule] and not seen[-2].active[rule]
    return is_now and len(starts) > 1 and starts[-1] - starts[-2] <= within_ns
