"""The feedback that rules have for a learner."""

from __future__ import annotations

import math

from rossmarie.check.expressions.infer import infer
from rossmarie.check.operations.operands import require_constant
from rossmarie.check.rules.errors import OddFeedback
from rossmarie.check.scopes.context import Context
from rossmarie.check.units.quantities import read_unit
from rossmarie.check.wording.describe import describe
from rossmarie.ir.model import Feedback
from rossmarie.syntax import ast
from rossmarie.types import Quantity, Unknown
from rossmarie.units import DIMENSIONLESS, parse_unit

_SECOND = parse_unit("s")


def check_feedback(rule: ast.Rule, context: Context) -> Feedback:
    """The amounts of a rule; what is no amount is reported."""
    found: dict[bool, float] = {}
    for each in rule.feedback:
        per_time = each.time is not None
        amount = _amount(each, context)
        seconds = 1.0 if each.time is None else _seconds(each.time, context)
        if per_time in found:
            said = "time" if per_time else "activation"
            finding = OddFeedback(found=f"this is said twice per {said}")
            context.collector.add(finding.at(each.span))
        elif amount is not None and seconds is not None:
            found[per_time] = amount / seconds
    return Feedback(found.get(False, 0.0), found.get(True, 0.0))


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
    """The length of a unit of time; None, after reporting, if it is none."""
    known = read_unit(unit, context.collector)
    if known is None:
        return None
    if known.dimension == _SECOND.dimension:
        return known.scale
    finding = OddFeedback(found=f"`{unit.text}` is no time, and no activation")
    context.collector.add(finding.at(unit.span))
    return None
