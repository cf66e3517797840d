"""The limit of every target: no call may take too long because timers start each other
repeatedly.
"""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Diagnostic
from rossmarie import ir
from rossmarie.targets.errors import TooManyEvaluations


def unsupported(machine: ir.Machine) -> Iterator[Diagnostic]:
    """A finding for the first timer beyond the limit, if any."""
    found = 1  # the timer of the event itself
    for owner, count in ir.wakes(machine):
        found += count
        if found > ir.MOST_EVALUATIONS:
            often = "once" if count == 1 else f"{count} times"
            large = TooManyEvaluations(often=often, found=found, most=ir.MOST_EVALUATIONS)
            yield large.at(owner.span)
            return
