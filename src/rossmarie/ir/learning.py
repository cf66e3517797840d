"""The margins of a machine, and the machine without margins, for users that do not learn."""

from __future__ import annotations

import dataclasses

from rossmarie.ir import model as ir
from rossmarie.ir.feedback import Margin
from rossmarie.ir.support import compared_signals, signal_operands


def margins_of(machine: ir.Machine) -> tuple[Margin, ...]:
    """The margins that rules declare, in the order of the rules."""
    declared = (rule.feedback.margin for rule in machine.rules)
    return tuple(margin for margin in declared if margin is not None)


def below_margins(machine: ir.Machine) -> frozenset[int]:
    """The signals of margins, and all their operands."""
    found: set[int] = set()
    waiting = [margin.signal for margin in margins_of(machine)]
    while waiting:
        index = waiting.pop()
        if index not in found:
            found.add(index)
            waiting += signal_operands(machine.signals[index].node)
    return frozenset(found)


def without_margins(machine: ir.Machine) -> ir.Machine:
    """The machine without margins, which monitors, nodes and proofs use.

    Signals of margins come after all other signals. A margin that the rules use as a number
    remains.
    """
    if not margins_of(machine):
        return machine
    rules = tuple(
        dataclasses.replace(rule, feedback=dataclasses.replace(rule.feedback, margin=None))
        for rule in machine.rules
    )
    needed = {
        signal
        for proposition in machine.propositions
        for signal in compared_signals(proposition.node)
    }
    needed |= set(machine.readings)
    needed |= {signal for rule in rules for signal in rule.signals}
    signals = list(machine.signals)
    while signals and len(signals) - 1 not in needed:
        signals.pop()
    needed |= {each for signal in signals for each in signal_operands(signal.node)}
    assert all(index < len(signals) for index in needed), "margins stand behind all others"
    return dataclasses.replace(machine, signals=tuple(signals), rules=rules)
