"""The terms of a rule: the propositions in its verdicts (S41)."""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie.ir import model as ir
from rossmarie.ir.defined import defined
from rossmarie.ir.support import is_leaf, whole_operands


def rule_terms(machine: ir.Machine, condition: int) -> tuple[int, ...]:
    """The propositions in a verdict of a rule with this condition: named propositions, leaves,
    operators over time, and defined operators (`once`, `after`) instead of their parts.
    """
    return tuple(_terms(machine, condition))


def _terms(machine: ir.Machine, condition: int) -> Iterator[int]:
    for index in reported_propositions(machine, condition):
        proposition = machine.propositions[index]
        is_over_time = isinstance(proposition.node, ir.Held | ir.Since | ir.Recurs)
        is_telling = (
            proposition.name is not None or is_over_time or defined(machine, index) is not None
        )
        if is_telling or is_leaf(proposition.node):
            yield index


def reported_propositions(machine: ir.Machine, proposition: int) -> tuple[int, ...]:
    """The proposition and all its operands that users wrote, in index order, without elementwise
    ones.
    """
    found: set[int] = set()
    waiting = [proposition]
    while waiting:
        index = waiting.pop()
        if index not in found:
            found.add(index)
            whole = defined(machine, index)
            node = machine.propositions[index].node
            waiting.extend(whole_operands(node) if whole is None else whole.operands)
    return tuple(sorted(found))
