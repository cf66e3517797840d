"""The order of rules that need the same thing for themselves."""

from __future__ import annotations

import heapq
from collections.abc import Sequence

from dslkit.diagnostics import Label
from dslkit.source import Span
from rossmarie.check.action_errors import CircularPriority, UndeclaredRule, UnorderedRules
from rossmarie.check.context import Context
from rossmarie.check.order import in_order
from rossmarie.check.plans import Effects, reached_actions
from rossmarie.check.suggestions import near_name, rename
from rossmarie.syntax import ast


def order_of_rules(effects: Effects, context: Context) -> tuple[int, ...]:
    """The numbers of the rules, the most important first: that of the file, changed as little as
    the priorities demand. Reports what is wrong with these, and rules that need an order.
    """
    rules = context.declarations.rules
    under = _under(rules, context)
    _, circles = in_order(under)
    for circle in circles:
        _report_circle([_name(rules, rule) for rule in circle], context)
    if circles:
        return tuple(range(len(rules)))
    order = _sorted(under)
    _warn_of_unordered(rules, _related(order, under), effects, context)
    return order


def _under(rules: Sequence[ast.Rule], context: Context) -> dict[int, list[int]]:
    """Of each rule, those that it is put over."""
    numbers: dict[str, int] = {}
    for number, rule in enumerate(rules):
        if rule.name is not None:
            numbers.setdefault(rule.name.text, number)
    under: dict[int, list[int]] = {number: [] for number in range(len(rules))}
    for item in context.declarations.items:
        if not isinstance(item, ast.Priority):
            continue
        for name in item.rules:
            if name.text not in numbers and context.declarations.is_whole:
                _report_undeclared(name, tuple(numbers), context)
        for first, second in zip(item.rules, item.rules[1:], strict=False):
            if first.text in numbers and second.text in numbers:
                under[numbers[first.text]].append(numbers[second.text])
    return under


def _report_undeclared(name: ast.Name, known: tuple[str, ...], context: Context) -> None:
    near = near_name(name.text, known) if context.may_suggest() else None
    finding = UndeclaredRule(identifier=name.text)
    if near is None:
        context.collector.add(finding.at(name.span))
        return
    help, fix = f"did you mean `{near}`?", rename(name, near)
    context.collector.add(finding.at(name.span, help=help, fix=fix))


def _report_circle(names: list[str], context: Context) -> None:
    for item in context.declarations.items:
        if not isinstance(item, ast.Priority):
            continue
        place = next((name.span for name in item.rules if name.text == names[0]), None)
        if place is not None:
            shown = names if len(names) <= 8 else [*names[:7], "..."]
            cycle = " over ".join((*shown, names[0]))
            finding = CircularPriority(identifier=names[0], cycle=cycle)
            context.collector.add(finding.at(place))
            return


def _sorted(under: dict[int, list[int]]) -> tuple[int, ...]:
    """Each rule before those that it is put over; of several that may come next, the first."""
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


def _related(order: tuple[int, ...], under: dict[int, list[int]]) -> list[int]:
    """Of each rule the set of those that it has an order with, as the bits of a number."""
    below = [0] * len(order)
    for rule in reversed(order):
        for other in under[rule]:
            below[rule] |= below[other] | 1 << other
    above = [0] * len(order)
    for rule in order:
        for other in under[rule]:
            above[other] |= above[rule] | 1 << rule
    return [one | other for one, other in zip(below, above, strict=True)]


def _warn_of_unordered(
    rules: Sequence[ast.Rule], related: list[int], effects: Effects, context: Context
) -> None:
    """Warn of each rule that needs what an earlier one needs, with no order between them. Rules
    that need it for the same action can do without.
    """
    needing: dict[str, int] = {}
    alike: dict[tuple[str, frozenset[str]], int] = {}
    for number, rule in enumerate(rules):
        needs: dict[str, set[str]] = {}
        for action in reached_actions(rule, effects):
            for effect in effects.get(action, ()):
                if effect.resource is not None:
                    needs.setdefault(effect.resource, set()).add(action)
        warned = 0
        for resource, actions in needs.items():
            key = (resource, frozenset(actions))
            others = needing.get(resource, 0) & ~alike.get(key, 0) & ~related[number] & ~warned
            if others:
                first = (others & -others).bit_length() - 1
                warned |= 1 << first
                _warn(rules, first, number, resource, context)
            needing[resource] = needing.get(resource, 0) | 1 << number
            alike[key] = alike.get(key, 0) | 1 << number


def _warn(
    rules: Sequence[ast.Rule], first: int, second: int, resource: str, context: Context
) -> None:
    names = (_name(rules, first), _name(rules, second))
    advice = f"say which is more important: `priority {names[0]} over {names[1]};`"
    if rules[first].name is None or rules[second].name is None:
        advice = "name both rules, and say which is more important: `priority RULE over RULE;`"
    finding = UnorderedRules(first=names[0], second=names[1], resource=resource, advice=advice)
    place = Label(_head(rules[first]), "this rule needs it too")
    context.collector.add(finding.at(_head(rules[second]), place))


def _head(rule: ast.Rule) -> Span:
    return rule.condition.span if rule.name is None else rule.name.span


def _name(rules: Sequence[ast.Rule], number: int) -> str:
    name = rules[number].name
    return f"rule_{number + 1}" if name is None else name.text
