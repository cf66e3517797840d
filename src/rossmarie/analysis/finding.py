"""The finding of a query, and the texts that all queries share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from dslkit.diagnostics import Diagnostic, Remark
from rossmarie.analysis.errors import Shown, ShownWithLoss
from rossmarie.analysis.witness import Witness, reported
from rossmarie.ir import Constant, Machine, compared_signals, reachable_propositions


@dataclass(frozen=True)
class Finding:
    """A diagnostic, and the witness for it."""

    diagnostic: Diagnostic
    witness: Witness | None = None


def witness_note(machine: Machine, witness: Witness, propositions: Sequence[int]) -> Remark:
    """The note that describes a witness: the values that the propositions use, and their
    instants.
    """
    signals = {
        signal
        for root in propositions
        for proposition in reachable_propositions(machine, root)
        for signal in compared_signals(machine.propositions[proposition].node)
        if not isinstance(machine.signals[signal].node, Constant)
    }
    kind = Shown if witness.is_calm else ShownWithLoss
    return kind(trace=reported(machine, witness, sorted(signals)))
