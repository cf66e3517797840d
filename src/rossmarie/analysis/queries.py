"""All queries about a machine. Quick queries come first."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

from rossmarie.analysis.chattering import find_chattering
from rossmarie.analysis.conflict import find_conflicts
from rossmarie.analysis.decided import find_decided
from rossmarie.analysis.errors import Undecided
from rossmarie.analysis.failures import find_unnoticed
from rossmarie.analysis.feedback import find_alternating
from rossmarie.analysis.finding import Finding
from rossmarie.analysis.foresight import find_late
from rossmarie.analysis.holding import find_self_holding
from rossmarie.analysis.implied import find_implied
from rossmarie.analysis.inquiry import Inquiry, OutOfTimeError
from rossmarie.analysis.latches import find_released_latches
from rossmarie.analysis.rates import find_unfit_durations
from rossmarie.analysis.recovery import find_blocked
from rossmarie.analysis.release import find_never_cleared
from rossmarie.analysis.unproved import not_proved
from rossmarie.ir import Machine, Requirement

QUICK_S = 8.0
"""The time limit of the quick queries about one file, in seconds of CPU time."""

THOROUGH_S = 600.0
"""The time limit of all queries about one file, in seconds of CPU time."""

Query = Callable[[Inquiry], Iterator[Finding]]


def ask_all(
    machine: Machine,
    *,
    thorough: bool,
    within_ns: int,
    on_step: Callable[[str], None] = lambda _: None,
) -> Iterator[Finding]:
    """The findings of the quick queries, or of all queries; one finding if the time ran out.

    `within_ns` is the time in nanoseconds within which no rule may toggle. `on_step` is called with
    the name of each query.
    """
    if not machine.rules:
        return
    limit_s = THOROUGH_S if thorough else QUICK_S
    inquiry = Inquiry(machine, time.process_time() + limit_s)
    for name, query in _queries(thorough, within_ns).items():
        on_step(name)
        yield from _in_time(inquiry, name, query, limit_s)


def ask_required(
    required: Requirement, *, thorough: bool, on_step: Callable[[str], None] = lambda _: None
) -> Iterator[Finding]:
    """The findings on a requirement of a rule; one finding if the time ran out."""
    on_step("which rules act in time?")
    limit_s = THOROUGH_S if thorough else QUICK_S
    inquiry = Inquiry(required.machine, time.process_time() + limit_s)
    try:
        yield from find_late(inquiry, required)
    except OutOfTimeError:
        yield not_proved(required, _not_all_asked(limit_s))


def _in_time(inquiry: Inquiry, name: str, query: Query, limit_s: float) -> Iterator[Finding]:
    try:
        yield from query(inquiry)
    except OutOfTimeError:
        finding = Undecided(query=name, reason=_not_all_asked(limit_s))
        yield Finding(finding.at(inquiry.machine.rules[0].span))


def _not_all_asked(limit_s: float) -> str:
    return f"the time limit of {limit_s:g} s was reached; `--thorough` has no limit"


def _queries(thorough: bool, within_ns: int) -> dict[str, Query]:
    quick: dict[str, Query] = {
        "which rules are in conflict?": lambda asked: find_conflicts(asked, thorough=thorough),
        "which conditions are never or always true?": lambda asked: find_decided(
            asked, thorough=thorough
        ),
        "which stale inputs does no rule detect?": find_unnoticed,
        "which commands are blocked?": find_blocked,
        "which rules keep themselves active?": find_self_holding,
        "which latched rules do rules reset?": find_released_latches,
        "which durations do not fit the rates of messages?": find_unfit_durations,
        "which rules set each other off?": find_alternating,
    }
    slow: dict[str, Query] = {
        "which rules add nothing?": find_implied,
        "which rules are never cleared?": find_never_cleared,
        "which rules toggle fast?": lambda asked: find_chattering(asked, within_ns),
    }
    return {**quick, **slow} if thorough else quick
