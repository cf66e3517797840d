"""Traversal of expressions without recursion, so that any depth is possible."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from rossmarie.syntax import ast


def children(expression: ast.Expression) -> tuple[ast.Expression, ...]:
    """The direct operands of an expression, in source order."""
    found: tuple[ast.Expression | None, ...]
    match expression:
        case ast.Bracket(elements=found) | ast.Call(arguments=found):
            pass
        case ast.Member(value=value) | ast.Index(value=value):
            found = (value,)
        case ast.Sector(value=value, arc=arc):
            found = (value, arc.first, arc.last)
        case ast.Unary(operand=value) | ast.Parenthesized(inner=value):
            found = (value,)
        case ast.Binary(left=left, right=right) | ast.Membership(value=left, container=right):
            found = (left, right)
        case ast.Held(condition=left, duration=right) | ast.Once(condition=left, duration=right):
            found = (left, right)
        case ast.Since(held=left, begun=right) | ast.ListFold(list=left, body=right):
            found = (left, right)
        case ast.Response(cause=cause, answer=answer, duration=duration):
            found = (cause, answer, duration)
        case ast.Edges(condition=left, window=last):
            found = (left, last)
        case ast.Oscillates(value=value, count=count, window=window, swing=swing):
            found = (value, count, window, swing)
        case (
            ast.Number() | ast.Boolean() | ast.Text() | ast.Reference() | ast.Doing()
            | ast.Broken()
        ):  # fmt: skip
            found = ()
    return tuple(child for child in found if child is not None)


def walk(expression: ast.Expression) -> Iterator[ast.Expression]:
    """The expression and all expressions inside it, each before its parts, from left to right."""
    pending = [expression]
    while pending:
        current = pending.pop()
        yield current
        pending.extend(reversed(children(current)))


def depth(expression: ast.Expression) -> int:
    """The depth of an expression: 1 for a name, 2 for `-x`."""
    deepest = 0
    pending = [(expression, 1)]
    while pending:
        current, level = pending.pop()
        deepest = max(deepest, level)
        pending.extend((child, level + 1) for child in children(current))
    return deepest


def expressions(
    item: ast.Item | ast.Condition | ast.Shape | ast.Effect | ast.Statement,
) -> Iterator[ast.Expression]:
    """The outermost expressions of an item or a part of an item, in source order."""
    if isinstance(item, ast.Effect):
        return _of_effect(item)
    if isinstance(item, ast.Statement):
        return _of_statement(item)
    return _of_item(item)


def _of_item(item: ast.Item | ast.Condition | ast.Shape) -> Iterator[ast.Expression]:
    match item:
        case ast.Constant(value=value):
            yield value
        case ast.Parameter() | ast.Import():
            yield from _of_parameters(item)
        case ast.Input(timeout=timeout) | ast.Skills(timeout=timeout) if timeout is not None:
            yield timeout
        case ast.Condition(expression=expression):
            yield expression
        case ast.Entity(conditions=conditions) | ast.Motion(parts=conditions):
            yield from (condition.expression for condition in conditions)
        case ast.Shape() | ast.Zone():
            shapes = item.shapes if isinstance(item, ast.Zone) else (item,)
            yield from chain.from_iterable(map(_of_shape, shapes))
        case ast.Rule():
            yield from _of_rule(item)
        case ast.Action(effects=effects):
            yield from chain.from_iterable(map(_of_effect, effects))
        case ast.System(members=members):
            yield from chain.from_iterable(map(_of_member, members))
        case ast.Test(statements=statements):
            yield from chain.from_iterable(map(_of_statement, statements))
        case ast.Input() | ast.Priority() | ast.Hazard() | ast.Skills():
            pass


def _of_shape(shape: ast.Shape) -> Iterator[ast.Expression]:
    yield from shape.brackets
    if shape.radius is not None:
        yield shape.radius


def _of_rule(rule: ast.Rule) -> Iterator[ast.Expression]:
    yield rule.condition
    yield from rule.scope
    yield from chain.from_iterable(map(_of_exemption, rule.exemptions))
    yield from chain.from_iterable(map(_of_contract, rule.contracts))
    yield from () if rule.keeps is None else (rule.keeps.speed,)
    yield from (each.amount for each in rule.feedback if isinstance(each, ast.Feedback))


def _of_parameters(item: ast.Parameter | ast.Import) -> Iterator[ast.Expression]:
    """The default of a parameter, or the values of an import, without topics."""
    values: tuple[ast.Expression | ast.Name | None, ...]
    match item:
        case ast.Import(given=given):
            values = tuple(each.value for each in given)
        case ast.Parameter(default=default):
            values = (default,)
    yield from (each for each in values if each is not None and not isinstance(each, ast.Name))


def _of_member(member: ast.SystemMember) -> Iterator[ast.Expression]:
    found: tuple[ast.Expression | None, ...] = ()
    if isinstance(member, ast.TopicDeclaration):
        found = (member.rate,)
    elif isinstance(member, ast.FrameDeclaration):
        found = (member.at, member.turned, member.timeout)
    yield from (expression for expression in found if expression is not None)


def _of_tree(effect: ast.RunTree) -> Iterator[ast.Expression]:
    for each in effect.arguments:
        if not isinstance(each.value, ast.Passed):
            yield each.value
    if effect.timeout is not None:
        yield effect.timeout


def _of_effect(effect: ast.Effect) -> Iterator[ast.Expression]:
    found: tuple[ast.Expression | None, ...]
    match effect:
        case ast.Limit(bounds=bounds, ramps=ramps):
            found = (*(bound.range for bound in bounds), *ramps)
        case ast.Scale(factor=factor, ramps=ramps):
            found = (factor, *ramps)
        case ast.Block(ramps=ramps):
            found = ramps
        case ast.Publish(assignments=assignments, rate=last):
            found = (*(each.value for each in assignments), last)
        case ast.Retrace(assignments=assignments, rate=last):
            values = (each.value for each in assignments)
            found = (effect.pose, *values, *effect.apart, last)
        case (
            ast.CallService(assignments=assignments, timeout=last)
            | ast.SendGoal(assignments=assignments, timeout=last)
        ):
            found = (*(each.value for each in assignments), last)
        case ast.RunTree():
            found = tuple(_of_tree(effect))
        case ast.SetParameter(value=value, timeout=last):
            found = (value, last)
        case ast.SwitchControllers(timeout=last):
            found = (last,)
        case ast.CancelGoal(confirmation=confirmation, timeout=last):
            found = (confirmation, last)
        case ast.Log() | ast.Diagnose() | ast.Hook() | ast.Reset():
            found = ()
    yield from (expression for expression in found if expression is not None)


def _of_statement(statement: ast.Statement) -> Iterator[ast.Expression]:
    found: list[ast.Expression | None] = []
    if isinstance(statement, ast.CommandExpectation):
        found.append(statement.range)
    found.append(statement.at)
    if isinstance(statement, ast.Arrival):
        found.append(statement.period)
    if not isinstance(statement, ast.OperatorReset) and statement.stretch is not None:
        found += [statement.stretch.first, statement.stretch.last]
    if isinstance(statement, ast.Arrival):
        for setting in statement.settings:
            found += [setting] if isinstance(setting, ast.Doing) else _of_setting(setting)
    yield from (expression for expression in found if expression is not None)


def _of_setting(setting: ast.Setting) -> Iterator[ast.Expression | None]:
    for step in setting.path.steps:
        if isinstance(step, ast.Arc):
            yield from (step.first, step.last)
    yield setting.value


def _of_exemption(exemption: ast.Exemption) -> Iterator[ast.Expression]:
    yield exemption.doing
    if exemption.condition is not None:
        yield exemption.condition


def _of_contract(contract: ast.ResumeContract) -> Iterator[ast.Expression]:
    match contract:
        case ast.ClearWhen(condition=condition):
            yield condition
        case ast.ClearFor(duration=duration):
            yield duration
        case ast.LatchedUntilReset():
            pass
