"""The end of rules: the clearing of a rule after its condition has become false."""

from __future__ import annotations

from rossmarie.ir import Literal, Machine, Rule, reachable_propositions


def is_cleared_at_once(machine: Machine, rule: Rule) -> bool:
    """Say whether a rule is cleared as soon as its condition is false."""
    if rule.release is None:
        return False
    node = machine.propositions[rule.release].node
    return isinstance(node, Literal) and node.value


def is_cleared_by_its_condition(machine: Machine, rule: Rule) -> bool:
    """Say whether a rule is cleared once its condition is false, at once or after a while."""
    if rule.release is None:
        return False
    is_held = rule.condition not in reachable_propositions(machine, rule.release)
    return is_cleared_at_once(machine, rule) or not is_held
