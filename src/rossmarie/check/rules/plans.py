"""The plans of rules: actions, escalations and latches, and their size."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rossmarie.check.effects import CheckedEffect
from rossmarie.check.rules.errors import CircularEscalation, LatchConflict, PlanTooLarge
from rossmarie.check.rules.order import circle_of, in_order
from rossmarie.check.scopes.context import Context
from rossmarie.syntax import ast

MOST_TASKS = 10_000
"""The most effects in all plans of a program. An effect counts once for each place at which it may
begin.
"""

Effects = Mapping[str, tuple[CheckedEffect, ...]]


def check_escalations(effects: Effects, context: Context) -> bool:
    """Report actions that lead back to themselves by `else`. Returns True if there are no such
    actions.
    """
    needs = {name: _otherwise(name, effects) for name in effects}
    _, circles = in_order(needs)
    for circle in circles:
        _report_circle(circle, context)
    itself = [
        step
        for rule in context.declarations.rules
        for step in rule.steps
        if step.otherwise is not None and step.otherwise.text == step.action.text
    ]
    for step in itself:
        name = step.action.text
        finding = CircularEscalation(identifier=name, cycle=f"{name} -> {name}")
        context.collector.add(finding.at(step.span))
    return not circles and not itself


def _otherwise(name: str, effects: Effects) -> tuple[str, ...]:
    named = (effect.otherwise for effect in effects.get(name, ()))
    return tuple(dict.fromkeys(one for one in named if one is not None))


def _report_circle(circle: tuple[str, ...], context: Context) -> None:
    action = context.declarations.names[circle[0]]
    following = circle[1 % len(circle)]
    assert isinstance(action, ast.Action), "only actions have effects"
    place = next(
        (
            effect.otherwise.span
            for effect in action.effects
            if isinstance(effect, ast.Awaited)
            and effect.otherwise is not None
            and effect.otherwise.text == following
        ),
        action.name.span,
    )
    finding = CircularEscalation(identifier=circle[0], cycle=circle_of(circle))
    context.collector.add(finding.at(place))


def reached_actions(rule: ast.Rule, effects: Effects) -> Iterator[str]:
    """The actions that a rule names, and all that follow their failures, each once."""
    pending = [
        name.text
        for step in rule.steps
        for name in (step.action, step.otherwise)
        if name is not None
    ]
    seen: set[str] = set()
    while pending:
        name = pending.pop(0)
        if name not in seen:
            seen.add(name)
            yield name
            pending.extend(_otherwise(name, effects))


def latch_of(rule: ast.Rule, effects: Effects, actions: Mapping[str, object]) -> ast.Action | None:
    """The latched action of a rule, if the rule has one."""
    for name in reached_actions(rule, effects):
        action = actions.get(name)
        if isinstance(action, ast.Action) and action.latch is not None:
            return action
    return None


def check_latches(effects: Effects, context: Context) -> None:
    """Report rules that use a latched action although they have a contract for clearing."""
    for rule in context.declarations.rules:
        action = latch_of(rule, effects, context.declarations.names)
        for contract in rule.contracts:
            if action is None or action.latch is None:
                break
            if not isinstance(contract, ast.LatchedUntilReset):
                finding = LatchConflict(identifier=action.name.text)
                place = finding.Latched(action=action.name.text).at(action.latch.span)
                context.collector.add(finding.at(contract.span, place))


def check_size(effects: Effects, context: Context) -> bool:
    """Report the first rule with which the plans become too large. Returns True if there is none.
    The escalations must have no circles.
    """
    order, _ = in_order({name: _otherwise(name, effects) for name in effects})
    tasks: dict[str, int] = {}
    open_ends: dict[str, int] = {}
    for name in order:
        own = effects.get(name, ())
        following = [effect.otherwise for effect in own if effect.otherwise is not None]
        tasks[name] = len(own) + sum(tasks.get(one, 0) for one in following)
        ends = sum(effect.otherwise is None and effect.may_fail for effect in own)
        open_ends[name] = ends + sum(open_ends.get(one, 0) for one in following)
    total = 0
    for rule in context.declarations.rules:
        for step in rule.steps:
            name = step.action.text
            behind = 0 if step.otherwise is None else tasks.get(step.otherwise.text, 0)
            total += tasks.get(name, 0) + open_ends.get(name, 0) * behind
        if total > MOST_TASKS:
            context.collector.add(PlanTooLarge(most=MOST_TASKS).at(rule.head))
            return False
    return True
