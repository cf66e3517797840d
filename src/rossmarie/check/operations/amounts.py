"""Calls of `braking_distance` and `time_to`: their units, and the signs of constants."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rossmarie.check.operations.function_errors import UnfitAmount
from rossmarie.check.operations.operands import scalar_operand
from rossmarie.check.scopes.context import Context
from rossmarie.check.units.quantities import SECOND, CheckedOperand
from rossmarie.check.wording.describe import describe
from rossmarie.syntax import ast
from rossmarie.types import Operator, Quantity, Type, Unknown, apply, distance_unit, unit_faults
from rossmarie.units import Unit, divide

AMOUNTS: Mapping[Operator, str] = {
    Operator.BRAKING_DISTANCE: "braking_distance(speed, 1.2 m/s^2, 0.3 sec)",
    Operator.TIME_TO: "time_to(distance, closing_speed)",
}
"""The functions, with the notation of each."""


def type_of_amount(node: ast.Call, operator: Operator, context: Context) -> Type:
    """The type of a call with the right number of arguments."""
    operands = [scalar_operand(argument, context) for argument in node.arguments]
    known = [operand for operand in operands if operand is not None]
    if len(known) < len(operands):
        return Unknown()
    if operator is Operator.BRAKING_DISTANCE:
        is_right = _check_braking(node, known, context)
    else:
        is_right = _check_time(node, known, context)
    return apply(operator, *(each.quantity for each in known)).type if is_right else Unknown()


def _check_braking(node: ast.Call, operands: Sequence[CheckedOperand], context: Context) -> bool:
    speed, deceleration, latency = operands
    unit = distance_unit(speed.quantity)
    if unit is None:
        found = describe(speed.quantity)
        _report(node, speed, "the speed", "in m/s or rad/s", found, context)
        return False
    braking = divide(divide(unit, SECOND), SECOND)
    has_units = (
        _has_unit(node, deceleration, "the deceleration", braking, context),
        _has_unit(node, latency, "the latency", SECOND, context),
    )
    return all(has_units) and _check_signs(node, deceleration, latency, context)


def _check_signs(
    node: ast.Call, deceleration: CheckedOperand, latency: CheckedOperand, context: Context
) -> bool:
    brake, delay = (context.values.get(each.node) for each in (deceleration, latency))
    if brake is not None and not brake.numbers[0] > 0.0:
        found = f"{brake.numbers[0]:g} in SI"
        _report(node, deceleration, "the deceleration", "more than zero", found, context)
        return False
    if delay is not None and delay.numbers[0] < 0.0:
        found = f"{delay.numbers[0]:g} s"
        _report(node, latency, "the latency", "zero or more", found, context)
        return False
    return True


def _check_time(node: ast.Call, operands: Sequence[CheckedOperand], context: Context) -> bool:
    left, closing = operands
    unit = left.quantity.unit
    if unit is None or unit.offset:
        expected = "a number with a unit that is not a temperature"
        _report(node, left, "the distance", expected, describe(left.quantity), context)
        return False
    return _has_unit(node, closing, "the closing speed", divide(unit, SECOND), context)


def _has_unit(
    node: ast.Call, operand: CheckedOperand, part: str, unit: Unit, context: Context
) -> bool:
    found = operand.quantity
    if found.unit is not None and not unit_faults(found, Quantity(unit)):
        return True
    _report(node, operand, part, f"in {unit.symbol}", describe(found), context)
    return False


def _report(
    node: ast.Call, operand: CheckedOperand, part: str, expected: str, found: str, context: Context
) -> None:
    function = node.function.text
    finding = UnfitAmount(
        function=function,
        part=part,
        expected=expected,
        found=found,
        usage=AMOUNTS[Operator(function)],
    )
    context.collector.add(finding.at(operand.node.span))
