"""The declared priorities of rules that need the same resource."""

from __future__ import annotations

import heapq
from collections.abc import Sequence

from rossmarie.check.rules.errors import CircularPriority
from rossmarie.check.rules.order import circle_of, in_order
from rossmarie.check.rules.rule_names import name_of, numbers_of, report_undeclared
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.exemptions import exempted_by
from rossmarie.syntax import ast

Pairs = tuple[tuple[int, int], ...]


def order_of_rules(context: Context) -> tuple[tuple[int, ...], Pairs]:
    """The numbers of the rules, the most important first, and the pairs that priorities order. The
    order is the order of the file, changed as little as the priorities require. Errors are
    reported.
    """
    rules = context.declarations.rules
    under = _under(rules, context)
    _, circles = in_order(under)
    for circle in circles:
        _report_circle([name_of(rules, rule) for rule in circle], context)
    if circles:
        return tuple(range(len(rules))), ()
    pairs = dict.fromkeys((rule, other) for rule, below in under.items() for other in below)
    return _sorted(under), tuple(pairs)


def _under(rules: Sequence[ast.Rule], context: Context) -> dict[int, list[int]]:
    """The rules over which each rule has priority. An exempted rule also has priority over the
    rules made from its exemptions.
    """
    numbers = numbers_of(rules)
    under: dict[int, list[int]] = {number: [] for number in range(len(rules))}
    for item in context.declarations.items:
        if not isinstance(item, ast.Priority):
            continue
        for name in item.rules:
            if name.text not in numbers and context.declarations.is_whole:
                report_undeclared(name, numbers, context)
        for first, second in zip(item.rules, item.rules[1:], strict=False):
            if first.text in numbers and second.text in numbers:
                under[numbers[first.text]].append(numbers[second.text])
    for number in under:
        exempted = exempted_by(rules, number)
        if exempted is not None:
            under[exempted].append(number)
    return under


def _report_circle(names: list[str], context: Context) -> None:
    for item in context.declarations.items:
        if not isinstance(item, ast.Priority):
            continue
        place = next((name.span for name in item.rules if name.text == names[0]), None)
        if place is not None:
            cycle = circle_of(names, " over ")
            finding = CircularPriority(identifier=names[0], cycle=cycle)
            context.collector.add(finding.at(place))
            return


def _sorted(under: dict[int, list[int]]) -> tuple[int, ...]:
    """The rules, each before the rules over which it has priority. Among several candidates, the
    first in the file comes next.
    """
    waits_for = dict.fromkeys(under, 0)
    for below in under.values():
        for rule in below:
            waits_for[rule] += 1
    ready = [rule for rule, count in waits_for.items() if count == 0]
    order = []
    while ready:
        rule = heapq.heappop(ready)
        order.append(rule)
        for other in under[rule]:
            waits_for[other] -= 1
            if waits_for[other] == 0:
                heapq.heappush(ready, other)
    return tuple(order)
