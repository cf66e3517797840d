"""The part of a machine that some rules depend on. Queries use it so that a query about a few rules
costs no more in a large file than in a small file.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

from rossmarie import ir


def part_of(machine: ir.Machine, rules: Sequence[int]) -> ir.Machine:
    """A machine with these rules, in this order, and everything that they depend on. Its channels
    are unchanged, so the same messages witness the same findings.
    """
    chosen = [machine.rules[rule] for rule in rules]
    return _cut(machine, [root for rule in chosen for root in rule.roots], chosen)


def part_below(machine: ir.Machine, proposition: int) -> ir.Machine:
    """A machine without rules, with everything that a proposition depends on. The proposition is
    its last proposition.
    """
    return _cut(machine, (proposition,), ())


def _cut(machine: ir.Machine, roots: Sequence[int], chosen: Sequence[ir.Rule]) -> ir.Machine:
    propositions, signals = _below(machine, roots)
    places = {proposition: place for place, proposition in enumerate(sorted(propositions))}
    numbers = {signal: place for place, signal in enumerate(sorted(signals))}
    return dataclasses.replace(
        machine,
        signals=tuple(
            dataclasses.replace(
                machine.signals[index],
                node=_moved_signal(machine.signals[index].node, numbers, places),
            )
            for index in numbers
        ),
        propositions=tuple(
            dataclasses.replace(
                machine.propositions[index],
                node=moved_proposition(machine.propositions[index].node, numbers, places),
            )
            for index in places
        ),
        rules=tuple(_moved_rule(rule, numbers, places) for rule in chosen),
        watches=(),
        readings=(),
        reactions=ir.NO_REACTIONS,
    )


def _below(machine: ir.Machine, roots: Sequence[int]) -> tuple[set[int], set[int]]:
    """The propositions and signals that some propositions depend on, including elementwise ones."""
    propositions: set[int] = set()
    signals: set[int] = set()
    waiting, numbers = list(roots), list[int]()
    while waiting or numbers:
        if waiting:
            proposition = waiting.pop()
            if proposition not in propositions:
                propositions.add(proposition)
                node = machine.propositions[proposition].node
                waiting += ir.proposition_operands(node)
                numbers += ir.compared_signals(node)
            continue
        signal = numbers.pop()
        if signal not in signals:
            signals.add(signal)
            found = machine.signals[signal].node
            numbers += ir.signal_operands(found)
            waiting += (found.element,) if isinstance(found, ir.Count) else ()
    return propositions, signals


def _moved_rule(rule: ir.Rule, numbers: Mapping[int, int], places: Mapping[int, int]) -> ir.Rule:
    return dataclasses.replace(
        rule,
        condition=places[rule.condition],
        release=None if rule.release is None else places[rule.release],
        terms=tuple(places[term] for term in rule.terms),
        signals=tuple(numbers[signal] for signal in rule.signals),
    )


def _moved_signal(
    node: ir.SignalNode, numbers: Mapping[int, int], places: Mapping[int, int]
) -> ir.SignalNode:
    match node:
        case ir.Apply(operands=operands):
            return dataclasses.replace(node, operands=tuple(numbers[each] for each in operands))
        case ir.Sampled(signal=signal):
            return dataclasses.replace(node, signal=numbers[signal])
        case ir.Fold(element=element):
            return dataclasses.replace(node, element=numbers[element])
        case ir.Count(element=element):
            return ir.Count(places[element])
        case ir.Constant() | ir.Read() | ir.Element():
            return node


def moved_proposition(
    node: ir.PropositionNode, numbers: Mapping[int, int], places: Mapping[int, int]
) -> ir.PropositionNode:
    """A proposition with new numbers for its signals, and new indices for its propositions."""
    match node:
        case ir.Compare(left=left, right=right):
            return dataclasses.replace(node, left=numbers[left], right=numbers[right])
        case ir.Between(signal=signal, low=low, high=high):
            return ir.Between(numbers[signal], numbers[low], numbers[high])
        case ir.Flag(signal=signal) | ir.Oscillates(signal=signal):
            return dataclasses.replace(node, signal=numbers[signal])
        case ir.Quantified(element=element):
            return dataclasses.replace(node, element=places[element])
        case ir.Not(operand=operand) | ir.Held(operand=operand) | ir.Recurs(operand=operand):
            return dataclasses.replace(node, operand=places[operand])
        case ir.Since(held=held, begun=begun):
            return ir.Since(places[held], places[begun])
        case ir.And(operands=operands) | ir.Or(operands=operands):
            return dataclasses.replace(node, operands=tuple(places[each] for each in operands))
        case ir.Literal() | ir.AgeReaches():
            return node
