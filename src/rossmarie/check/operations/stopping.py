"""The speeds to which motions slow down: `stopping(drive, 0.3 m/s)`."""

from __future__ import annotations

import math

from rossmarie.check.model import CheckedMotion
from rossmarie.check.operations.function_errors import UnfitMotionPart
from rossmarie.check.operations.operands import require_constant, scalar_operand
from rossmarie.check.scopes.context import Context
from rossmarie.check.wording.describe import describe
from rossmarie.syntax import ast
from rossmarie.types import Quantity, Unknown, unit_faults
from rossmarie.units import parse_unit

_SPEED = Quantity(parse_unit("m/s"))


def constant(part: str, node: ast.Expression, may_be_zero: bool, context: Context) -> float | None:
    """A positive constant number in SI; None, after reporting, if it is not positive."""
    if not require_constant(node, part, context):
        return None
    number = context.values[node].numbers[0]
    if math.isfinite(number) and (number > 0.0 or (may_be_zero and number == 0.0)):
        return number
    expected = "zero or more" if may_be_zero else "more than zero"
    finding = UnfitMotionPart(part=part, expected=expected, found=f"{number:g} in SI")
    context.collector.add(finding.at(node.span))
    return None


def wanted_speed(
    node: ast.Expression, motion: CheckedMotion | None, context: Context
) -> float | None:
    """A constant speed in m/s that a motion can exceed; None after reporting."""
    if isinstance(context.type_of(node), Unknown):
        return None
    operand = scalar_operand(node, context)
    if operand is None:
        return None
    if unit_faults(operand.quantity, _SPEED):
        finding = UnfitMotionPart(
            part="the speed", expected="a number in m/s", found=describe(operand.quantity)
        )
        context.collector.add(finding.at(node.span))
        return None
    speed = constant("the speed", node, True, context)
    if speed is not None and motion is not None and speed >= motion.fastest:
        name = motion.declaration.name.text
        expected = f"less than `fastest` of `{name}`, {motion.fastest:g} m/s"
        finding = UnfitMotionPart(part="the speed", expected=expected, found=f"{speed:g} m/s")
        context.collector.add(finding.at(node.span))
        return None
    return speed
