"""The findings about rules for which the solver gives no answer. This module needs no solver."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rossmarie.analysis.errors import NotAsked, NotProved
from rossmarie.analysis.finding import Finding
from rossmarie.ir import Machine, Requirement


def without_solver(
    machine: Machine, requirements: Sequence[Requirement], advice: str
) -> Iterator[Finding]:
    """A warning that no query was asked, and an error for each requirement: an unproved requirement
    counts as violated. `advice` is the command that installs the solver.
    """
    yield Finding(NotAsked(advice=advice).at(machine.rules[0].head))
    for required in requirements:
        yield not_proved(required, "the solver z3 is not installed, so no proof was tried")


def not_proved(required: Requirement, reason: str) -> Finding:
    """The error on a requirement that is neither proved nor refuted."""
    finding = NotProved(
        rule=required.rule,
        reason=reason,
        places=required.places,
        motion=required.braking.motion,
        speed=shown_speed(required),
    )
    return Finding(finding.at(required.span))


def shown_speed(required: Requirement) -> str:
    """The speed that a requirement promises to stay below, in m/s."""
    return f"{required.speed:g} m/s"
