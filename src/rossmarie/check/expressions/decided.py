"""Conditions that are always true or always false, whatever messages arrive.

Such conditions are legal: constants can switch rules on and off. But if no input can change the
value, a monitor watches nothing.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie.check.expressions.errors import ConstantCondition, NeverCleared
from rossmarie.check.expressions.parameters import rests_on_parameter
from rossmarie.check.operations.elements import Temporal
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import constant_of, stripped
from rossmarie.syntax import ast
from rossmarie.syntax.node_map import NodeMap
from rossmarie.syntax.walk import children, walk
from rossmarie.types import Boolean, Unknown


def warn_of_decided(expression: ast.Expression, context: Context) -> None:
    """Warn of a condition, or of its parts, that no input influences.

    `true` alone, or the name of a constant, is a switch if it is only a part of the condition.
    """
    parts = list(walk(expression))
    if any(isinstance(context.types.get(part), Unknown) for part in parts):
        return
    outcomes = _outcomes(parts, context)
    if not outcomes and not _is_apart(expression, context):
        return
    pending = [(expression, True)]
    while pending:
        node, is_whole = pending.pop()
        outcome = outcomes.get(node)
        if outcome is not None and rests_on_parameter(node, context):
            continue  # another value of the parameter may change the result
        if outcome is not None and (is_whole or not _is_switch(node, context)):
            _report(node, "true" if outcome else "false", context)
        elif is_whole and _is_apart(node, context):
            _report(node, "the same", context)
        else:
            pending.extend(_parts(node, is_whole))


def warn_of_never_cleared(rule: ast.Rule, contract: ast.ClearWhen, context: Context) -> None:
    """Warn of a condition after `clear when` that cannot be true while the condition of the rule
    is false: both conditions are the same, or the first requires everything that makes the second
    true.
    """
    needed = _spellings(contract.condition, ast.BinaryOperator.AND)
    for part in (rule.condition, *_joined(rule.condition, ast.BinaryOperator.OR)):
        if needed.issuperset({_spelling(part)}) or needed.issuperset(
            map(_spelling, _joined(part, ast.BinaryOperator.AND))
        ):
            context.collector.add(NeverCleared().at(contract.condition.span))
            return


def _spellings(node: ast.Expression, operator: ast.BinaryOperator) -> set[str]:
    return {_spelling(part) for part in (node, *_joined(node, operator))}


def _joined(node: ast.Expression, operator: ast.BinaryOperator) -> Iterator[ast.Expression]:
    """The operands of a chain of one operator, without the parentheses around them."""
    pending = [node]
    while pending:
        part = stripped(pending.pop())
        if isinstance(part, ast.Binary) and part.operator is operator:
            pending += [part.right, part.left]
        else:
            yield part


def _spelling(node: ast.Expression) -> str:
    return " ".join(stripped(node).span.text.split())


def _parts(node: ast.Expression, is_whole: bool) -> Iterator[tuple[ast.Expression, bool]]:
    """The nodes inside a node, each with a flag: True if it still decides the whole condition."""
    if isinstance(node, ast.Held):
        yield node.condition, True
        return
    keeps = is_whole and isinstance(node, ast.Parenthesized | ast.Unary)
    yield from ((part, keeps) for part in reversed(children(node)))


def _report(node: ast.Expression, outcome: str, context: Context) -> None:
    context.collector.add(ConstantCondition(outcome=outcome).at(node.span))


def _is_switch(node: ast.Expression, context: Context) -> bool:
    inner = stripped(node)
    while isinstance(inner, ast.Unary):
        inner = stripped(inner.operand)
    is_named = constant_of(inner, context.declarations) is not None
    return is_named or isinstance(inner, ast.Boolean)


def _is_apart(node: ast.Expression, context: Context) -> bool:
    """Say whether a condition names no input, no skill and no other condition, and uses no time."""
    return isinstance(context.type_of(node), Boolean) and not any(
        isinstance(part, Temporal | ast.Doing)
        or (isinstance(part, ast.Reference) and constant_of(part, context.declarations) is None)
        for part in walk(node)
    )


def _outcomes(parts: list[ast.Expression], context: Context) -> NodeMap[bool]:
    """The booleans among `parts` that constants alone decide, each before the parts inside it."""
    outcomes: NodeMap[bool] = NodeMap()
    for node in reversed(parts):
        if isinstance(context.type_of(node), Boolean):
            outcome = _outcome(node, outcomes, context)
            if outcome is not None:
                outcomes[node] = outcome
    return outcomes


def _outcome(node: ast.Expression, outcomes: NodeMap[bool], context: Context) -> bool | None:
    value = context.values.get(node)
    if value is not None:
        return value.boolean
    match node:
        case ast.Parenthesized(inner=inner):
            return outcomes.get(inner)
        case ast.Unary(operator=ast.UnaryOperator.NOT, operand=operand) if operand in outcomes:
            return not outcomes[operand]
        case ast.Binary(operator=ast.BinaryOperator.AND | ast.BinaryOperator.OR as operator):
            deciding = operator is ast.BinaryOperator.OR
            sides = (outcomes.get(node.left), outcomes.get(node.right))
            return deciding if deciding in sides else None
        case ast.Held(condition=condition) if outcomes.get(condition) is False:
            return False
        case ast.Since(begun=condition) | ast.Once(condition=condition):
            return outcomes.get(condition)
        case ast.Response(cause=cause, answer=answer) if (
            outcomes.get(cause) is False or outcomes.get(answer) is True
        ):
            return True
        case (
            ast.Number() | ast.Boolean() | ast.Text() | ast.Bracket() | ast.Reference()
            | ast.Member() | ast.Index() | ast.Sector() | ast.Call() | ast.Edges()
            | ast.Oscillates() | ast.ListFold() | ast.Unary() | ast.Binary() | ast.Membership()
            | ast.Held() | ast.Response() | ast.Doing() | ast.Broken()
        ):  # fmt: skip
            return None
