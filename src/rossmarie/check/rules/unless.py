"""Rules that give way to other rules: `if ... unless OTHER then ...`."""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie.check.rules.errors import CircularUnless
from rossmarie.check.rules.order import circle_of, in_order
from rossmarie.check.rules.rule_names import name_of, numbers_of, report_undeclared
from rossmarie.check.scopes.context import Context
from rossmarie.syntax import ast


def giving_way(context: Context) -> tuple[tuple[int, ...], ...]:
    """For each rule, the numbers of the rules that suspend it while one of them is active.

    Reports unknown rules, and circles.
    """
    rules = context.declarations.rules
    numbers = numbers_of(rules)
    for rule in rules:
        for name in rule.unless if rule.made_from is None else ():
            if name.text not in numbers and context.declarations.is_whole:
                report_undeclared(name, numbers, context)
    found = {number: _numbers(rule, numbers) for number, rule in enumerate(rules)}
    _, circles = in_order(found)
    for circle in circles:
        _report(circle, rules, context)
    return tuple(found.values())


def _numbers(rule: ast.Rule, numbers: dict[str, int]) -> tuple[int, ...]:
    known = (numbers[name.text] for name in rule.unless if name.text in numbers)
    return tuple(dict.fromkeys(known))


def _report(circle: Sequence[int], rules: Sequence[ast.Rule], context: Context) -> None:
    names = [name_of(rules, number) for number in circle]
    following = names[1 % len(names)]
    place = next(name.span for name in rules[circle[0]].unless if name.text == following)
    cycle = circle_of(names, " unless ")
    context.collector.add(CircularUnless(identifier=names[0], cycle=cycle).at(place))
