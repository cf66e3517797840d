"""The names of rules, as declared and as used in other rules and priorities."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rossmarie.check.rules.errors import UndeclaredRule
from rossmarie.check.scopes.context import Context
from rossmarie.syntax import ast


def numbers_of(rules: Sequence[ast.Rule]) -> dict[str, int]:
    """The number of each named rule. Of two rules with one name, the first counts."""
    numbers: dict[str, int] = {}
    for number, rule in enumerate(rules):
        if rule.name is not None:
            numbers.setdefault(rule.name.text, number)
    return numbers


def name_of(rules: Sequence[ast.Rule], number: int) -> str:
    """The name of a rule in messages."""
    return rule_names(rules)[number]


def report_undeclared(name: ast.Name, known: Iterable[str], context: Context) -> None:
    """Report a name that no rule has."""
    context.report_unknown(UndeclaredRule(identifier=name.text), name, known)


def rule_names(rules: Sequence[ast.Rule]) -> list[str]:
    """The names of rules. A rule without a name gets a name by its position among the written
    rules, `rule_2`.
    """
    taken = {rule.name.text for rule in rules if rule.name is not None}
    names: list[str] = []
    position = 0
    for rule in rules:
        position += rule.made_from is None
        name = f"rule_{position}" if rule.name is None else rule.name.text
        while rule.name is None and name in taken:
            name += "_"
        names.append(name)
    return names
