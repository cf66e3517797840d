"""Proofs about the generated C as the results of a report: the rules, then all queries."""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie import ir
from rossmarie.report.proofs import Proofs
from rossmarie.report.safety.evidence import AnsweredQuery, EvidenceKind
from rossmarie.verification.message_checks import ELEMENTS

_PROVED, _, _, _NOT_PROVED = EvidenceKind.VERIFICATION.statuses


def bound_of(machine: ir.Machine) -> str:
    """The limits of proofs about the C of a machine, and their assumptions."""
    arrays = f"; arrays of up to {ELEMENTS} elements" if machine.arrays else ""
    has_clouds = any(ir.POINTS in each.path for each in machine.lists)
    clouds = "; not how nodes take points out of the bytes of clouds" if has_clouds else ""
    return (
        "one step from any well-formed state, so no bound on messages, timers, values or time"
        f"{arrays}{clouds}; arc sines, arc tangents and square roots may be any functions"
    )


def verification_results(proofs: Proofs) -> Iterator[AnsweredQuery]:
    """The results: first, for each rule, whether it is correct in runs of any length, which depends
    on all parts.
    """
    for name in proofs.rules:
        yield AnsweredQuery(
            name=f"rule {name} in runs of any length",
            status=_PROVED if proofs.is_inductive else _NOT_PROVED,
            detail="rests on every query about the monitor",
        )
    for outcome in proofs.outcomes:
        yield AnsweredQuery(
            name=outcome.check.about,
            status=outcome.verdict.value,
            detail="; ".join((f"check_{outcome.check.name}", *proofs.reasons(outcome))),
        )
    for name in proofs.unasked:
        yield AnsweredQuery(name=name, status=_NOT_PROVED, detail="no query covers this part")
