"""Limits of the C99 target: machines that are too large for its tables."""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Diagnostic
from rossmarie import ir
from rossmarie.ir.reactions import Limit
from rossmarie.targets.c99.layout import lay_out
from rossmarie.targets.c99.state import recent_counts
from rossmarie.targets.errors import MonitorTooLarge

MOST_INDEXES = 0xFFFE
"""The greatest usable index. The next index means "none"."""

_NAME = "C99"


def unsupported(machine: ir.Machine) -> Iterator[Diagnostic]:
    """A finding for the first table that does not fit, if any. Without rules every table fits."""
    for what, found in _table_sizes(machine).items():
        if found > MOST_INDEXES and machine.rules:
            large = MonitorTooLarge(target=_NAME, what=what, found=found, most=MOST_INDEXES)
            yield large.at(machine.rules[-1].span)
            return


def _table_sizes(machine: ir.Machine) -> dict[str, int]:
    layout = lay_out(machine)
    propositions = (proposition.node for proposition in machine.propositions)
    operands = sum(len(ir.proposition_operands(node)) for node in propositions)
    inputs = [used for used in range(len(machine.inputs)) if layout.has_timeout(used)]
    stale = sum(used in value.support.inputs for value in layout.values for used in inputs)
    blames = sum(len(layout.guard_blames(guard)) for guard in layout.guards)
    supports = (layout.values[guard.value].support for guard in layout.guards)
    effects = [task.effect for task in machine.reactions.tasks]
    bounds = sum(len(effect.bounds) for effect in effects if isinstance(effect, Limit))
    excuses = sum(len(layout.excuses(support)) for support in supports)
    return {
        "conditions and rules": layout.proposition_count + len(machine.rules),
        "operands of conditions": operands + 2 * len(machine.rules),
        "limits": sum(len(guard.limits) + 2 for guard in layout.guards),
        "numbers": len(layout.values),
        "turning points and edges": sum(recent_counts(layout)),
        "numbers that expire": stale,
        "reasons to be unknown": max(blames, excuses) + layout.leaf_count,
        "terms of verdicts": sum(len(rule.terms) for rule in machine.rules),
        "numbers of verdicts": sum(len(rule.signals) for rule in machine.rules),
        "inputs of verdicts": sum(len(rule.inputs) for rule in machine.rules),
        "task commands": 2 * len(effects),
        "bounds of commands": bounds,
    }
