"""Exemptions as rules: the rules made from `unless doing SKILL` after a rule.

A rule R with an exemption stays unchanged. Two rules are added: R_doing_SKILL, which is active
while the exemption is used, and R_while_SKILL if the exemption has another condition.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence

from rossmarie.syntax import ast


def with_exemptions(rules: Sequence[ast.Rule]) -> tuple[ast.Rule, ...]:
    """The rules, each followed by the rules made from its exemptions."""
    found: list[ast.Rule] = []
    for position, rule in enumerate(rules, start=1):
        found.append(rule)
        own = f"rule_{position}" if rule.name is None else rule.name.text
        found += _made_from(rule, own)
    return tuple(found)


def _made_from(rule: ast.Rule, name: str) -> Iterator[ast.Rule]:
    counts: dict[str, int] = {}
    for exemption in rule.exemptions:
        skill = exemption.doing.skill.text
        counts[skill] = counts.get(skill, 0) + 1
        suffix = skill if counts[skill] == 1 else f"{skill}_{counts[skill]}"
        steps = exemption.steps or ()
        if exemption.condition is None:
            yield _made(rule, exemption, f"{name}_doing_{suffix}", rule.condition, steps)
        else:
            yield _made(rule, exemption, f"{name}_doing_{suffix}", rule.condition, ())
            yield _made(rule, exemption, f"{name}_while_{suffix}", exemption.condition, steps)


def _made(
    rule: ast.Rule,
    exemption: ast.Exemption,
    name: str,
    condition: ast.Expression,
    steps: tuple[ast.Step, ...],
) -> ast.Rule:
    """A rule made from an exemption. It has no contract, so the replacement ends with the
    exemption. It mitigates the hazard of the original rule if it has an action.
    """
    return dataclasses.replace(
        rule,
        name=ast.Name(name, exemption.doing.span),
        condition=condition,
        steps=steps,
        contracts=(),
        feedback=(),
        mitigates=rule.mitigates if steps else (),
        documentation=None,
        span=exemption.span,
        always=None,
        exemptions=(),
        keeps=None,
        made_from=exemption,
    )


def is_of_exempted(rule: ast.Rule) -> bool:
    """Say whether a rule made from an exemption uses the condition of the exempted rule, not a
    condition of its own.
    """
    return rule.made_from is not None and rule.condition is not rule.made_from.condition


def exempted_by(rules: Sequence[ast.Rule], number: int) -> int | None:
    """The number of the rule from whose exemption a rule was made; None if the rule was not made
    from an exemption.
    """
    if rules[number].made_from is None:
        return None
    return max(each for each in range(number) if rules[each].made_from is None)
