"""The feedback of rules to a learner."""

from __future__ import annotations

import math

from rossmarie.check.expressions.infer import infer
from rossmarie.check.model import CheckedFeedback
from rossmarie.check.operations.operands import require_constant
from rossmarie.check.rules.errors import OddFeedback
from rossmarie.check.rules.margins import check_margin
from rossmarie.check.scopes.context import Context
from rossmarie.check.units.quantities import read_unit
from rossmarie.check.wording.describe import describe
from rossmarie.syntax import ast
from rossmarie.types import Quantity, Unknown
from rossmarie.units import DIMENSIONLESS, Unit, parse_unit

_SECOND = parse_unit("s")
_ONCE, _LASTING = " per activation", " per time"


def check_feedback(rule: ast.Rule, context: Context) -> CheckedFeedback:
    """The amounts of a rule, and its margin. Other values are reported."""
    found: dict[str, float] = {}
    margin: Unit | None = None
    said: set[str] = set()
    for each in rule.feedback:
        kind = _kind(each)
        if kind in said:
            finding = OddFeedback(found=f"this is given twice{kind}")
            context.collector.add(finding.at(each.span))
        elif isinstance(each, ast.Margin):
            margin = check_margin(rule, each, context)
        else:
            found[kind] = _rate(each, context)
        said.add(kind)
    return CheckedFeedback(found.get(_ONCE, 0.0), found.get(_LASTING, 0.0), margin)


def _kind(each: ast.Feedback | ast.Margin) -> str:
    """The words that distinguish one feedback of a rule from the others."""
    if isinstance(each, ast.Margin):
        return ""
    return _ONCE if each.time is None else _LASTING


def _rate(feedback: ast.Feedback, context: Context) -> float:
    """An amount, or an amount per second; 0 after reporting."""
    amount = _amount(feedback, context)
    seconds = 1.0 if feedback.time is None else _seconds(feedback.time, context)
    return 0.0 if amount is None or seconds is None else amount / seconds


def _amount(feedback: ast.Feedback, context: Context) -> float | None:
    node = feedback.amount
    type_ = infer(node, context)
    if isinstance(type_, Unknown) or not require_constant(node, "feedback", context):
        return None
    is_plain = isinstance(type_, Quantity) and type_.unit in (None, DIMENSIONLESS)
    value = context.values[node].numbers[0] if is_plain else -1.0
    if is_plain and value >= 0.0 and math.isfinite(value):
        return value
    found = f"this is {value:g}" if is_plain else f"this is {describe(type_)}"
    context.collector.add(OddFeedback(found=found).at(node.span))
    return None


def _seconds(unit: ast.Unit, context: Context) -> float | None:
    """The length of a unit of time in s; None, after reporting, if it is not a unit of time."""
    known = read_unit(unit, context.collector)
    if known is None:
        return None
    if known.dimension == _SECOND.dimension:
        return known.scale
    finding = OddFeedback(found=f"`{unit.text}` is neither a time nor `activation`")
    context.collector.add(finding.at(unit.span))
    return None
