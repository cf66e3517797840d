"""A selection of rules by category: `--only human`.

The whole program is checked first. The selection is a program with the matching rules, which keep
their names, their order and all other results of the check. Tests concern all rules, so a selection
has none.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import replace

from dslkit.diagnostics import Collector
from dslkit.source import Span
from rossmarie.check.model import CheckedProgram
from rossmarie.check.rules.errors import LeftOutRule, NothingSelected
from rossmarie.check.rules.rule_names import rule_names
from rossmarie.ir.filing import Category, LeftOut, is_selected
from rossmarie.syntax import ast


def select(
    program: CheckedProgram,
    modules: Sequence[ast.Module],
    only: Sequence[Category],
    collector: Collector,
) -> CheckedProgram | None:
    """The program with the rules that match `only`, or the whole program if `only` is empty.
    Returns None after reporting a selection without rules. Reports priorities that name a rule
    outside the selection.
    """
    if not only:
        return program
    kept = [
        number
        for number, categories in enumerate(program.categories)
        if is_selected(categories, only)
    ]
    if not kept:
        finding = NothingSelected(only=_listed(only), known=_known(program))
        collector.add(finding.at(Span(modules[-1].file, 0, 0)))
        return None
    names = rule_names(program.rules)
    left_out = tuple(name for number, name in enumerate(names) if number not in kept)
    orders = [each for module in modules for each in module.items if isinstance(each, ast.Priority)]
    _report_left_out(orders, [program.rules[number] for number in kept], left_out, collector)
    return _reduced(program, kept, names, LeftOut(tuple(only), left_out))


def _known(program: CheckedProgram) -> str:
    """The categories of the rules, each with its number of rules."""
    counts = Counter(each for categories in program.categories for each in categories)
    if not counts:
        return "no rule has a category"
    found = (f"{each.value} ({counts[each]})" for each in Category if counts[each])
    return f"the rules have: {', '.join(found)}"


def _listed(only: Sequence[Category]) -> str:
    return " and ".join(f"`{each.value}`" for each in only)


def _report_left_out(
    orders: Sequence[ast.Priority],
    kept: Sequence[ast.Rule],
    left_out: Collection[str],
    collector: Collector,
) -> None:
    """Report each priority that names both a selected rule and a rule outside the selection."""
    names = {rule.name.text for rule in kept if rule.name is not None}
    reported = [
        (name, "the order applies only to the other rules")
        for order in orders
        if any(name.text in names for name in order.rules)
        for name in order.rules
    ]
    effect = "it is never active here, so no rule gives way to it"
    reported += [(name, effect) for rule in kept for name in rule.unless]
    for name, effect in reported:
        if name.text in left_out:
            collector.add(LeftOutRule(identifier=name.text, effect=effect).at(name.span))


def _reduced(
    program: CheckedProgram, kept: Sequence[int], names: Sequence[str], left_out: LeftOut
) -> CheckedProgram:
    """The program with these rules only, renumbered."""
    new = {number: place for place, number in enumerate(kept)}
    rules = tuple(_named(program.rules[number], names[number]) for number in kept)
    return replace(
        program,
        rules=rules,
        order=tuple(new[number] for number in program.order if number in new),
        priorities=tuple(
            (new[first], new[second])
            for first, second in program.priorities
            if first in new and second in new
        ),
        unless=tuple(
            tuple(new[other] for other in program.unless[number] if other in new) for number in kept
        ),
        feedback=tuple(program.feedback[number] for number in kept),
        categories=tuple(program.categories[number] for number in kept),
        keeps=tuple(program.keeps[number] for number in kept),
        left_out=left_out,
        tests=(),
    )


def _named(rule: ast.Rule, name: str) -> ast.Rule:
    """A rule without a name; it keeps the name from its original position."""
    return rule if rule.name is not None else replace(rule, name=ast.Name(name, rule.head))
