"""Missing parts: a file without rules, an action without effects, an input without a timeout."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from dslkit.diagnostics import Label
from dslkit.source import Span
from rossmarie.check.actions.errors import DoesNothing
from rossmarie.check.model import ConditionKey
from rossmarie.check.rules.errors import MissingTimeout, NoRules
from rossmarie.check.scopes.context import Context, ItemUses
from rossmarie.check.scopes.declarations import kind_of
from rossmarie.syntax import ast


def warn_of_missing_rules(context: Context) -> None:
    """Warn of a main file that declares conditions or inputs, or nothing at all, without any rule,
    its own or imported.

    A file of system models, actions and constants is meant for import.
    """
    if context.declarations.rules:
        return
    items = context.declarations.main.items
    if not items:
        start = Span(context.declarations.main.file, 0, 0)
        context.collector.add(NoRules(what="this file declares nothing").at(start))
    entities = (item for item in items if isinstance(item, ast.Entity))
    inputs = (item for item in items if isinstance(item, ast.Input))
    first = next(entities, None) or next(inputs, None)
    if first is not None:
        what = f"no rule depends on this {kind_of(first)}"
        context.collector.add(NoRules(what=what).at(first.name.span))


def warn_of_empty_braces(context: Context) -> None:
    """Warn of every action and every rule with empty braces."""
    for item in context.declarations.items:
        if isinstance(item, ast.Action) and item.body is not None and not item.effects:
            finding = DoesNothing(what="action")
            help = finding.Action(name=item.name.text)
            context.collector.add(finding.at(item.body, help=help))
    for rule in context.declarations.rules:
        if not rule.steps and rule.made_from is None:
            finding = DoesNothing(what="rule")
            context.collector.add(finding.at(rule.span, help=finding.Rule()))


def warn_of_missing_timeouts(
    resting: Sequence[tuple[Label, ItemUses]],
    conditions: Mapping[ConditionKey, ItemUses],
    context: Context,
) -> None:
    """Warn of every input without a timeout on which an item of `resting` depends, directly or
    indirectly. The label names the item.
    """
    warned: set[str] = set()
    seen: set[ConditionKey] = set()
    for place, uses in resting:
        reached = {name for part in _reached(uses, conditions, seen) for name in part.inputs}
        for name in sorted(reached - warned):
            declaration = context.inputs[name].declaration
            # A timeout that could not be read is already reported.
            is_topic = declaration.topic.text and declaration.setting is None
            if declaration.timeout is None and is_topic:
                warned.add(name)
                finding = MissingTimeout(identifier=name)
                context.collector.add(finding.at(declaration.name.span, place))


def _reached(
    uses: ItemUses, conditions: Mapping[ConditionKey, ItemUses], seen: set[ConditionKey]
) -> Iterator[ItemUses]:
    """The uses that a rule depends on, without the conditions `seen` for earlier rules."""
    pending = [uses]
    while pending:
        current = pending.pop()
        yield current
        new = [key for key in current.conditions if key not in seen and key in conditions]
        seen.update(new)
        pending.extend(conditions[key] for key in new)
