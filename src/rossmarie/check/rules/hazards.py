"""Hazards, and the rules that mitigate them."""

from __future__ import annotations

from collections.abc import Mapping

from rossmarie.check.rules.errors import UndeclaredHazard, UnmitigatedHazard
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.declarations import report_second
from rossmarie.syntax import ast


def declared_hazards(context: Context, *, is_parsed: bool) -> Mapping[str, ast.Hazard]:
    """The hazards by name. Reports rules that name unknown hazards and, if all files could be
    parsed, hazards that no rule mitigates.
    """
    found: dict[str, ast.Hazard] = {}
    for item in context.declarations.items:
        if isinstance(item, ast.Hazard):
            first = found.setdefault(item.name.text, item)
            if first is not item:
                reason = "rules refer to a hazard by its name"
                report_second(item.name, first.name, "hazard", reason, context.collector)
    mitigated = [name for rule in context.declarations.rules for name in rule.mitigates]
    for name in dict.fromkeys(mitigated):
        if name.text not in found and context.declarations.is_whole:
            context.report_unknown(UndeclaredHazard(identifier=name.text), name, found)
    used = {name.text for name in mitigated}
    for hazard in found.values():
        if is_parsed and context.declarations.rules and hazard.name.text not in used:
            finding = UnmitigatedHazard(identifier=hazard.name.text)
            context.collector.add(finding.at(hazard.name.span))
    return found
