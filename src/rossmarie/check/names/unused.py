"""Names that are declared but never used."""

from __future__ import annotations

from collections.abc import Mapping

from dslkit.diagnostics import Collector
from rossmarie.check.names.errors import UnusedName
from rossmarie.check.names.references import is_value_name
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.declarations import Named, kind_of
from rossmarie.syntax import ast

_REASONS: Mapping[str, str] = {
    "constant": "no condition compares a value with it",
    "parameter": "no condition compares a value with it",
    "input": "no condition reads it",
    "action": "no rule starts it",
    "entity": "no rule depends on it",
    "motion": "no rule depends on it",
    "zone": "no rule uses it",
    "condition": "no rule depends on it",
}


def warn_of_unused(context: Context) -> None:
    """Warn of every unused declaration of the main file.

    There is no warning for a file without rules: it may be meant for import, and other files use
    its names.
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


def _warn_of_entity(entity: ast.Entity, context: Context) -> None:
    """Report an entity without any used condition as one finding, not one for each condition."""
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
