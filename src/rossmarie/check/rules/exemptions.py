"""Exemptions and scopes of rules: the rules that may have them, and the queries in them."""

from __future__ import annotations

from dslkit.source import Span
from rossmarie.check.expressions.infer import infer
from rossmarie.check.rules.errors import AlwaysLimited, ExemptedHazard, RepeatedExemption
from rossmarie.check.scopes.context import Context
from rossmarie.syntax import ast


def check_exemptions(rule: ast.Rule, context: Context) -> None:
    """Check the skills that a rule names after its condition and its actions. Report skills on a
    rule that is always active, an exemption that leaves a hazard without a rule, and repeated
    exemptions.
    """
    for doing in (*rule.scope, *(each.doing for each in rule.exemptions)):
        infer(doing, context)
    if rule.always is not None:
        _check_always(rule, rule.always, context)
    seen: dict[object, ast.Exemption] = {}
    for exemption in rule.exemptions:
        asked = context.doing.get(exemption.doing)
        key = asked and (asked.skills, asked.arguments)
        first = exemption if key is None else seen.setdefault(key, exemption)
        if first is not exemption:
            repeated = RepeatedExemption(skill=exemption.doing.span.text)
            place = repeated.First().at(first.doing.span)
            context.collector.add(repeated.at(exemption.doing.span, place))
        if not exemption.steps and rule.mitigates:
            hazard = rule.mitigates[0]
            finding = ExemptedHazard(hazard=hazard.text, skill=exemption.doing.span.text)
            place = finding.Mitigated().at(hazard.span)
            context.collector.add(finding.at(exemption.span, place))


def _check_always(rule: ast.Rule, always: Span, context: Context) -> None:
    parts = [(scope, "scope") for scope in rule.scope]
    parts += [(each.doing, "exemption") for each in rule.exemptions]
    for doing, kind in parts:
        finding = AlwaysLimited(kind=kind)
        context.collector.add(finding.at(doing.span, finding.Always().at(always)))
