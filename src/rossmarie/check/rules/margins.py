"""The margins of rules. A margin is the distance of a condition to the point where its value
changes, in a unit.

A comparison of numbers has a distance; `and`, `or`, `not`, `any`, `all` and `for` pass it on.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dslkit.diagnostics import Edit, Fix
from dslkit.source import Span
from rossmarie.check.operations.operands import is_age, is_edge_count
from rossmarie.check.rules.errors import MarginUnit, NoMargin
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import text_of
from rossmarie.check.units.quantities import CheckedOperand, operand_of, read_unit
from rossmarie.syntax import ast
from rossmarie.units import DIMENSIONLESS, Unit

_WITH_SIDES = frozenset(
    {
        ast.BinaryOperator.LESS,
        ast.BinaryOperator.LESS_OR_EQUAL,
        ast.BinaryOperator.GREATER,
        ast.BinaryOperator.GREATER_OR_EQUAL,
    }
)
"""The comparisons that are true on one side of a limit."""


def check_margin(rule: ast.Rule, margin: ast.Margin, context: Context) -> Unit | None:
    """The unit of a declared margin; None, after reporting, if the margin is not possible."""
    unit = DIMENSIONLESS if margin.unit is None else read_unit(margin.unit, context.collector)
    compared: list[CheckedOperand] = []
    without = 0
    for part in _parts(rule.condition, context):
        reason = _reason(part, context)
        operand = None if reason is not None else _compared(part, context)
        if reason is not None:
            finding = NoMargin(found=reason)
            asked = finding.Asked().at(margin.span)
            context.collector.add(finding.at(part.span, asked))
            without += 1
        elif operand is not None:
            compared.append(operand)
    if unit is None or without or not compared:
        return None
    return unit if _fits(compared, unit, margin, context) else None


# --- the parts of a condition ------------------------------------------------------------------


def _parts(condition: ast.Expression, context: Context) -> Iterator[ast.Expression]:
    """The parts of a condition that determine its distance. Each named condition occurs once."""
    named: set[tuple[str, str]] = set()
    waiting: list[tuple[ast.Expression, str | None]] = [(condition, None)]
    while waiting:
        node, entity = waiting.pop()
        key = _named(node, entity, context)
        if key is not None:
            if key not in named:
                named.add(key)
                owner, name = key
                waiting.append((context.declarations.conditions[owner][name].expression, owner))
            continue
        inner = () if node in context.values else _operands(node)
        waiting += [(each, entity) for each in reversed(inner)]
        if not inner:
            yield node


def _operands(node: ast.Expression) -> Sequence[ast.Expression]:
    """The conditions that determine the distance of a node; empty if no operands determine it."""
    match node:
        case ast.Parenthesized(inner=inner) | ast.Held(condition=inner):
            return (inner,)
        case ast.Unary(operator=ast.UnaryOperator.NOT, operand=operand):
            return (operand,)
        case ast.Binary(operator=operator, left=left, right=right) if operator in ast.JUNCTIONS:
            return (left, right)
        case ast.Call(function=function, arguments=(argument,)) if function.text in ("any", "all"):
            return (argument,)
        case ast.ListFold(function=function, body=body) if function.text in ("any", "all"):
            return (body,)
        case (
            ast.Number() | ast.Boolean() | ast.Text() | ast.Bracket() | ast.Reference()
            | ast.Member() | ast.Index() | ast.Sector() | ast.Call() | ast.Edges()
            | ast.Oscillates() | ast.ListFold() | ast.Unary() | ast.Binary() | ast.Membership()
            | ast.Since() | ast.Once() | ast.Response() | ast.Doing() | ast.Broken()
        ):  # fmt: skip
            return ()


def _named(node: ast.Expression, entity: str | None, context: Context) -> tuple[str, str] | None:
    """The condition that a node names. Inside an entity, its own conditions need no prefix."""
    conditions = context.declarations.conditions
    if isinstance(node, ast.Member) and isinstance(node.value, ast.Reference):
        owner, name = node.value.name.text, node.member.text
    elif isinstance(node, ast.Reference) and entity is not None:
        owner, name = entity, node.name.text
    else:
        return None
    return (owner, name) if name in conditions.get(owner, {}) else None


def _compared(node: ast.Expression, context: Context) -> CheckedOperand | None:
    """The compared numbers; None if they are unknown, which is reported."""
    match node:
        case ast.Binary(left=left, right=right):
            sides = [operand_of(side, context) for side in (right, left)]
            known = [side for side in sides if side is not None]
            if len({_unit(side).dimension for side in known}) > 1:
                return None
            constant = [side for side in known if side.node in context.values]
            return next(iter((*constant, *known)), None)
        case ast.Membership(container=container, value=value):
            return operand_of(container, context) or operand_of(value, context)
        case _:  # open: for other parts, `_reason` explains why they have no distance
            return None


def _reason(node: ast.Expression, context: Context) -> str | None:
    """The description of a part without a distance; None if it has a distance, or is already
    reported.
    """
    if node in context.values:
        return "a constant never changes"
    match node:
        case ast.Membership() | ast.Broken():
            return None
        case ast.Binary():
            return _reason_of_comparison(node)
        case ast.Since():
            return "`since` remembers"
        case ast.Once():
            return "`once` remembers"
        case ast.Response():
            return "`after` waits"
        case ast.Oscillates():
            return "`oscillates` counts turning points"
        case ast.Call(function=function):
            return f"`{function.text}` gives true or false"
        case (
            ast.Number() | ast.Boolean() | ast.Text() | ast.Bracket() | ast.Reference()
            | ast.Member() | ast.Index() | ast.Sector() | ast.Edges() | ast.ListFold() | ast.Unary()
            | ast.Held() | ast.Doing() | ast.Parenthesized()
        ):  # fmt: skip
            return f"`{text_of(node)}` is true or false"


def _reason_of_comparison(node: ast.Binary) -> str | None:
    sides = (node.left, node.right)
    if any(map(is_age, sides)):
        return "an age changes with the clock, not with the actions of the robot"
    if any(map(is_edge_count, sides)):
        return "a count of edges is not a distance"
    if node.operator in _WITH_SIDES:
        return None
    return f"`{node.operator.value}` compares with a single value, which has no distance to a limit"


# --- units -------------------------------------------------------------------------------------


def _fits(
    compared: Sequence[CheckedOperand], unit: Unit, margin: ast.Margin, context: Context
) -> bool:
    """Say whether all comparisons and the margin have the same dimension. Report the first that
    differs.
    """
    first = compared[0]
    for other in compared[1:]:
        if _unit(other).dimension != _unit(first).dimension:
            finding = MarginUnit(one=_words(_unit(other)), other=_words(_unit(first)))
            help = finding.Apart()
            labels = (
                finding.First(one=_words(_unit(first))).at(first.node.span),
                finding.Asked().at(margin.span),
            )
            context.collector.add(finding.at(other.node.span, *labels, help=help))
            return False
    wanted = _unit(first)
    if wanted.dimension == unit.dimension:
        return True
    finding = MarginUnit(one=_words(unit), other=_words(wanted))
    meant = "margin" if wanted == DIMENSIONLESS else f"margin in {wanted.symbol}"
    label = finding.First(one=_words(wanted)).at(first.node.span)
    fix = _fix(margin, meant)
    context.collector.add(finding.at(margin.span, label, help=finding.Meant(meant=meant), fix=fix))
    return False


def _fix(margin: ast.Margin, meant: str) -> Fix:
    span = Span(margin.span.file, margin.span.start, margin.span.end)
    return Fix(f"write `{meant}`", (Edit(span, meant),))


def _unit(operand: CheckedOperand) -> Unit:
    """The unit of an operand. A field of unknown unit counts as a plain number."""
    return operand.quantity.unit or DIMENSIONLESS


def _words(unit: Unit) -> str:
    return "a plain number" if unit.dimension == DIMENSIONLESS.dimension else f"in {unit.symbol}"
