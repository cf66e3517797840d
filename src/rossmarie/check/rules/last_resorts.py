"""Chains of escalations: no other rule may be able to overrule the last effect."""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass

from rossmarie.check.effects import (
    CheckedEffect,
    CheckedLimit,
    CheckedPublish,
    CheckedScale,
)
from rossmarie.check.rules.errors import LastResortOverruled
from rossmarie.check.rules.plans import Effects
from rossmarie.check.rules.rule_names import rule_names
from rossmarie.check.scopes.context import Context
from rossmarie.syntax import ast


@dataclass(frozen=True)
class _Begun:
    """An action in a plan, the action that follows its failure, and whether it is an escalation
    itself.
    """

    action: str
    last_resort: str | None
    is_escalation: bool


def check_last_resorts(
    effects: Effects,
    order: Sequence[int],
    unless: Sequence[Sequence[int]],
    commands: Container[str],
    context: Context,
) -> None:
    """Report each rule whose last escalations need a resource that a rule with higher priority may
    take. The escalations must have no circles. `commands` are the topics that may pass through the
    filter.
    """
    rules = context.declarations.rules
    names = rule_names(rules)
    needs = [_needs(rule, effects) for rule in rules]
    for place, number in enumerate(order):
        rule = rules[number]
        before = [
            other
            for other in order[:place]
            if other not in unless[number] and number not in unless[other]
        ]
        for effect in _last(rule, effects):
            owner = next(
                (other for other in before if _overrules(needs[other], effect, commands)), None
            )
            if owner is None or effect.resource is None:
                continue
            finding = LastResortOverruled(
                rule=names[number], other=names[owner], resource=effect.resource
            )
            one = finding.Ends(rule=names[number]).at(rule.head)
            other = finding.First(rule=names[owner]).at(rules[owner].head)
            context.collector.add(finding.at(effect.span, one, other))


def _needs(rule: ast.Rule, effects: Effects) -> list[CheckedEffect]:
    """The effects of a rule that need an exclusive resource, anywhere in its plan (R2)."""
    found = (each for begun in _begun(rule, effects) for each in effects.get(begun.action, ()))
    return [effect for effect in found if effect.resource is not None]


def _overrules(
    needs: Sequence[CheckedEffect], effect: CheckedEffect, commands: Container[str]
) -> bool:
    """Say whether a rule with these needs can take the resource of an effect. It cannot if its only
    use of the resource is to publish the same message.
    """
    rivals = [other.effect for other in needs if other.resource == effect.resource]
    found = effect.effect
    if isinstance(found, CheckedPublish) and found.topic not in commands:
        return any(rival != found for rival in rivals)
    return bool(rivals)


def _last(rule: ast.Rule, effects: Effects) -> Iterator[CheckedEffect]:
    """The effects of escalations without a further escalation, and without a parallel effect that
    bounds commands; each once.
    """
    for begun in _begun(rule, effects):
        own = effects.get(begun.action, ())
        is_bounding = any(isinstance(each.effect, CheckedLimit | CheckedScale) for each in own)
        if not begun.is_escalation or is_bounding:
            continue
        for each in own:
            if each.otherwise is None and begun.last_resort is None and each.may_fail:
                yield each


def _begun(rule: ast.Rule, effects: Effects) -> Iterator[_Begun]:
    """The actions of a plan, each once, with the action that follows its failure."""
    pending = [
        _Begun(step.action.text, None if step.otherwise is None else step.otherwise.text, False)
        for step in rule.steps
    ]
    seen: set[_Begun] = set()
    while pending:
        begun = pending.pop(0)
        if begun in seen:
            continue
        seen.add(begun)
        yield begun
        for effect in effects.get(begun.action, ()):
            if effect.otherwise is not None:
                pending.append(_Begun(effect.otherwise, begun.last_resort, True))
            elif begun.last_resort is not None and effect.may_fail:
                pending.append(_Begun(begun.last_resort, None, True))
