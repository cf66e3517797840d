"""What is declared and never used, and which inputs may fall silent unnoticed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from dslkit.diagnostics import Collector, Label
from dslkit.source import Span
from rossmarie.check.action_errors import DoesNothing
from rossmarie.check.context import Context, Uses
from rossmarie.check.declarations import Named, kind_of
from rossmarie.check.meaning_errors import MissingTimeout, NoRules, UnusedName
from rossmarie.check.model import ConditionKey
from rossmarie.check.names import is_value_name
from rossmarie.syntax import ast

_REASONS: Mapping[str, str] = {
    "constant": "nothing is compared with it",
    "input": "no condition reads it",
    "action": "no rule starts it",
    "entity": "no rule rests on it",
    "condition": "no rule rests on it",
}


def warn_of_unused(context: Context) -> None:
    """Warn of every unused declaration of the main file.

    A file without rules may be there to be imported: its names are used elsewhere.
    """
    main = context.declarations.main
    if not any(isinstance(item, ast.Rule) for item in main.items):
        return
    for item in main.items:
        if not isinstance(item, Named) or context.declarations.names[item.name.text] is not item:
            continue
        if isinstance(item, ast.Entity):
            _warn_of_entity(item, context)
        elif item.name.text not in context.used_names:
            _warn(kind_of(item), item.name, context.collector)


def warn_of_missing_rules(context: Context) -> None:
    """Warn of a main file with something to monitor, or with nothing at all, but no rule that does,
    its own or imported.

    A file of system models, actions and constants is there to be imported.
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
        what = f"no rule rests on this {kind_of(first)}"
        context.collector.add(NoRules(what=what).at(first.name.span))


def warn_of_empty_actions(context: Context) -> None:
    """Warn of every action with braces and nothing in them."""
    for item in context.declarations.items:
        if isinstance(item, ast.Action) and item.body is not None and not item.effects:
            advice = f"say what it does, or write `action {item.name.text};`"
            finding = DoesNothing(what="action", advice=advice)
            context.collector.add(finding.at(item.body))


def _warn_of_entity(entity: ast.Entity, context: Context) -> None:
    """An entity of which nothing is used is one finding, not one for each condition."""
    unused = [
        condition
        for condition in entity.conditions
        if (entity.name.text, condition.name.text) not in context.used_conditions
        and not is_value_name(condition.name.text, context)
    ]
    if len(unused) == len(entity.conditions):
        if entity.name.text not in context.used_names:
            _warn("entity", entity.name, context.collector)
        return
    for condition in unused:
        _warn("condition", condition.name, context.collector)


def _warn(kind: str, name: ast.Name, collector: Collector) -> None:
    finding = UnusedName(kind=kind, identifier=name.text, reason=_REASONS[kind])
    collector.add(finding.at(name.span))


def warn_of_missing_timeouts(
    resting: Sequence[tuple[Label, Uses]],
    conditions: Mapping[ConditionKey, Uses],
    context: Context,
) -> None:
    """Warn of every input without a timeout that something of `resting` rests on, directly or not;
    the label says what that is.
    """
    warned: set[str] = set()
    seen: set[ConditionKey] = set()
    for place, uses in resting:
        reached = {name for part in _reached(uses, conditions, seen) for name in part.inputs}
        for name in sorted(reached - warned):
            declaration = context.inputs[name].declaration
            # One that could not be read is reported already; it may well have a timeout.
            if declaration.timeout is None and declaration.topic.text:
                warned.add(name)
                finding = MissingTimeout(identifier=name)
                context.collector.add(finding.at(declaration.name.span, place))


def _reached(
    uses: Uses, conditions: Mapping[ConditionKey, Uses], seen: set[ConditionKey]
) -> Iterator[Uses]:
    """What a rule rests on, without the conditions that were `seen` behind earlier rules."""
    pending = [uses]
    while pending:
        current = pending.pop()
        yield current
        new = [key for key in current.conditions if key not in seen and key in conditions]
        seen.update(new)
        pending.extend(conditions[key] for key in new)
