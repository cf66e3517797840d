"""The operand and result types of operators and functions, with a rule for each.

A rule maps the types of the operands to the type of the result and the errors in the operands. No
operand has the type `Unknown`.
"""

from __future__ import annotations

import enum
from collections.abc import Callable
from dataclasses import dataclass

from rossmarie.types.model import (
    Array,
    Boolean,
    Box,
    Interval,
    Message,
    Motion,
    Quantity,
    Quaternion,
    Region,
    Text,
    Type,
    Unknown,
    Vector,
)
from rossmarie.units import DIMENSIONLESS, Unit, divide, multiply, parse_unit, unit_of_differences

_SECONDS = Quantity(parse_unit("s"))
_METRES = Quantity(parse_unit("m"))
_RADIANS = Quantity(parse_unit("rad"))
_SPEED = Quantity(parse_unit("m/s"))
_SQUARE_SECOND = parse_unit("s^2")


class Fault(enum.Enum):
    """The reasons why an operator cannot be applied to its operands."""

    OPERANDS = "the operator does not take operands of such types"
    VECTOR = "a vector stands where a single number is needed"
    RANGE = "an interval or box stands where a single number is needed"
    NOT_A_RANGE = "what follows `in` is a single number"
    UNITS = "the dimensions of the units differ"
    UNSTATED_UNIT = "one operand has a unit and that of the other, a message field, is not known"
    TEMPERATURE = "a temperature in degC is no amount that can be added, scaled or negated"


@dataclass(frozen=True)
class OperatorType:
    """The type of the result, and the errors in the operands. With errors the type is `Unknown`."""

    type: Type
    faults: tuple[Fault, ...] = ()


Rule = Callable[..., OperatorType]
"""A function of the types of the operands. No operand has the type `Unknown`."""


def unit_faults(left: Quantity, right: Quantity) -> tuple[Fault, ...]:
    """The reasons why two numbers may not be compared. A number of unknown unit is comparable with
    plain numbers.
    """
    if left.unit is None or right.unit is None:
        other = left.unit or right.unit or DIMENSIONLESS
        return () if other.dimension == DIMENSIONLESS.dimension else (Fault.UNSTATED_UNIT,)
    return () if left.unit.dimension == right.unit.dimension else (Fault.UNITS,)


def fault(*faults: Fault) -> OperatorType:
    """The result of an operation with these errors."""
    return OperatorType(Unknown(), faults)


def _unfit(*operands: Type) -> OperatorType:
    """The error if at least one operand is not a number."""
    if any(isinstance(operand, (Interval, Box)) for operand in operands):
        return fault(Fault.RANGE)
    numbers = all(isinstance(operand, (Vector, Quantity)) for operand in operands)
    return fault(Fault.VECTOR if numbers else Fault.OPERANDS)


def elementwise(rule: Rule, *operands: Type) -> OperatorType:
    """The outcome for arrays, which follows from a rule for scalars."""
    if not any(isinstance(operand, Array) for operand in operands):
        return rule(*operands)
    elements = (operand.element if isinstance(operand, Array) else operand for operand in operands)
    outcome = rule(*elements)
    if isinstance(outcome.type, (Quantity, Boolean)):
        return OperatorType(Array(outcome.type), outcome.faults)
    return fault(*(outcome.faults or (Fault.OPERANDS,)))


# --- booleans --------------------------------------------------------------------------------


def logical(*operands: Type) -> OperatorType:
    """The outcome of `and`, `or` and `not` for booleans."""
    fits = all(isinstance(operand, Boolean) for operand in operands)
    return OperatorType(Boolean()) if fits else fault(Fault.OPERANDS)


def held(condition: Type, duration: Type) -> OperatorType:
    """The outcome of `C for d`."""
    faults = (*logical(condition).faults, *ordered(duration, _SECONDS).faults)
    return OperatorType(Boolean(), faults)


def fold(result: Type, elements: Type) -> OperatorType:
    """The outcome of `any`, `all` and `count` for the propositions of an array."""
    fits = isinstance(elements, Array) and isinstance(elements.element, Boolean)
    return OperatorType(result) if fits else fault(Fault.OPERANDS)


# --- comparison ------------------------------------------------------------------------------


def ordered(left: Type, right: Type) -> OperatorType:
    """The outcome of `a < b` and similar, for numbers with matching units."""
    if isinstance(left, Quantity) and isinstance(right, Quantity):
        return OperatorType(Boolean(), unit_faults(left, right))
    if isinstance(left, Vector) and isinstance(right, Quantity):
        return fault(Fault.VECTOR, *unit_faults(left.element, right))
    if isinstance(left, Quantity) and isinstance(right, Vector):
        return fault(Fault.VECTOR, *unit_faults(left, right.element))
    return _unfit(left, right)


def equal(left: Type, right: Type) -> OperatorType:
    """The outcome of `==` and `!=`, for booleans, texts, or numbers."""
    for kind in (Boolean, Text):
        if isinstance(left, kind) and isinstance(right, kind):
            return OperatorType(Boolean())
    return ordered(left, right)


def contained(value: Type, container: Type) -> OperatorType:
    """The outcome of `in`, for a range or the locations of a class."""
    if isinstance(container, Quantity):
        return fault(Fault.NOT_A_RANGE, *ordered(value, container).faults)
    if isinstance(container, Interval) and isinstance(value, (Quantity, Vector)):
        return ordered(value, container.element)
    if isinstance(container, Box) and isinstance(value, Vector):
        return OperatorType(Boolean(), unit_faults(value.element, container.element))
    if isinstance(container, Region) and container.has_area:
        return OperatorType(Boolean(), faults_of_position(value))
    return fault(Fault.OPERANDS)


# --- arithmetic ------------------------------------------------------------------------------


def additive(
    unit_rule: Callable[[Unit, Unit], Unit | None], left: Type, right: Type
) -> OperatorType:
    """The outcome of a sum or difference; `unit_rule` gives None for meaningless uses of
    temperatures.
    """
    if isinstance(left, Vector) and isinstance(right, Vector):
        return _as_vector(additive(unit_rule, left.element, right.element))
    if not (isinstance(left, Quantity) and isinstance(right, Quantity)):
        return ordered(left, right)
    faults = unit_faults(left, right)
    if faults or left.unit is None or right.unit is None:
        return OperatorType(Quantity(None), faults)
    unit = unit_rule(left.unit, right.unit)
    return fault(Fault.TEMPERATURE) if unit is None else OperatorType(Quantity(unit))


def unit_of_sum(left: Unit, right: Unit) -> Unit | None:
    """The unit of a sum; None if both are temperatures."""
    if left.offset and right.offset:
        return None
    return right if right.offset else left


def unit_of_difference(left: Unit, right: Unit) -> Unit | None:
    """The unit of a difference; None if a temperature is subtracted from another quantity."""
    if right.offset:
        return unit_of_differences(left) if left.offset else None
    return left


def _multiplicative(
    unit_rule: Callable[[Unit, Unit], Unit], left: Type, right: Type
) -> OperatorType:
    """The outcome of a product or quotient; an operand of unknown unit makes the unit unknown."""
    if not (isinstance(left, Quantity) and isinstance(right, Quantity)):
        return _unfit(left, right)
    if left.unit is None or right.unit is None:
        return OperatorType(Quantity(None))
    if left.unit.offset or right.unit.offset:
        return fault(Fault.TEMPERATURE)
    return OperatorType(Quantity(unit_rule(left.unit, right.unit)))


def product(left: Type, right: Type) -> OperatorType:
    """The outcome of `a * b`; a vector is multiplied by components."""
    if isinstance(left, Vector) and isinstance(right, Quantity):
        return _as_vector(_multiplicative(multiply, left.element, right))
    if isinstance(left, Quantity) and isinstance(right, Vector):
        return _as_vector(_multiplicative(multiply, left, right.element))
    return _multiplicative(multiply, left, right)


def quotient(left: Type, right: Type) -> OperatorType:
    """The outcome of `a / b`; a vector is divided by components."""
    if isinstance(left, Vector) and isinstance(right, Quantity):
        return _as_vector(_multiplicative(divide, left.element, right))
    return _multiplicative(divide, left, right)


def negative(value: Type) -> OperatorType:
    """The outcome of `-a`; a vector is negated by components."""
    return _as_vector(magnitude(value.element)) if isinstance(value, Vector) else magnitude(value)


def magnitude(value: Type) -> OperatorType:
    """A number with the same unit. A temperature is an error."""
    if not isinstance(value, Quantity):
        return _unfit(value)
    return fault(Fault.TEMPERATURE) if value.unit and value.unit.offset else OperatorType(value)


def _as_vector(outcome: OperatorType) -> OperatorType:
    if isinstance(outcome.type, Quantity) and not outcome.faults:
        return OperatorType(Vector(outcome.type))
    return outcome


# --- functions -------------------------------------------------------------------------------


def norm(value: Type) -> OperatorType:
    """The length of a vector."""
    return magnitude(value.element) if isinstance(value, Vector) else fault(Fault.OPERANDS)


def hypot(left: Type, right: Type) -> OperatorType:
    """The length of a vector with these two components."""
    if isinstance(left, Quantity) and isinstance(right, Quantity):
        return additive(lambda one, other: None if other.offset else one, left, right)
    return _unfit(left, right)


def wave(angle: Type) -> OperatorType:
    """The sine or the cosine of an angle."""
    is_angle = isinstance(angle, Quantity) and not unit_faults(angle, _RADIANS)
    return OperatorType(Quantity(DIMENSIONLESS)) if is_angle else fault(Fault.OPERANDS)


def distance(left: Type, right: Type) -> OperatorType:
    """The distance of two points, or of a point from the locations of a class."""
    if isinstance(left, Vector) and isinstance(right, Vector):
        return additive(unit_of_difference, left.element, right.element)
    if isinstance(right, Region):
        return OperatorType(_METRES, faults_of_position(left))
    return fault(Fault.OPERANDS)


def stopping(motion: Type, *speed: Type) -> OperatorType:
    """The distance in which a motion slows down to a speed, or stops."""
    if not isinstance(motion, Motion):
        return fault(Fault.OPERANDS)
    faults = (fault for each in speed for fault in ordered(each, _SPEED).faults)
    return OperatorType(_METRES, tuple(faults))


def braking_distance(speed: Type, deceleration: Type, latency: Type) -> OperatorType:
    """The braking distance for a speed: in m for a speed in m/s, in rad for a speed in rad/s."""
    if not (
        isinstance(speed, Quantity)
        and isinstance(deceleration, Quantity)
        and isinstance(latency, Quantity)
    ):
        return _unfit(speed, deceleration, latency)
    unit = distance_unit(speed)
    if unit is None:
        return fault(Fault.UNITS)
    faults = (
        *unit_faults(deceleration, Quantity(divide(unit, _SQUARE_SECOND))),
        *unit_faults(latency, _SECONDS),
    )
    return OperatorType(Quantity(unit), faults)


def distance_unit(speed: Quantity) -> Unit | None:
    """The unit of the distance for a speed, m or rad; None if the number is not a speed."""
    units = (parse_unit("m"), parse_unit("rad"))
    return next((unit for unit in units if not unit_faults(speed, Quantity(speed_of(unit)))), None)


def speed_of(unit: Unit) -> Unit:
    """The unit of a speed whose distance has this unit."""
    return divide(unit, parse_unit("s"))


def time_to(left: Type, closing_speed: Type) -> OperatorType:
    """The time in which a remaining distance is covered."""
    if not (isinstance(left, Quantity) and isinstance(closing_speed, Quantity)):
        return _unfit(left, closing_speed)
    if left.unit is None or closing_speed.unit is None:
        return fault(Fault.UNSTATED_UNIT)
    if left.unit.offset or closing_speed.unit.offset:
        return fault(Fault.TEMPERATURE)
    return OperatorType(_SECONDS, unit_faults(closing_speed, Quantity(speed_of(left.unit))))


def faults_of_position(value: Type) -> tuple[Fault, ...]:
    """The reasons why a value is not a point in a plane. A pose is a point by its position."""
    position = value.fields.get("position") if isinstance(value, Message) else value
    is_position = isinstance(position, Vector) and not unit_faults(position.element, _METRES)
    return () if is_position else (Fault.OPERANDS,)


def extreme(*values: Type) -> OperatorType:
    """The least or greatest element of one array, or of several scalars."""
    if len(values) == 1:
        (array,) = values
        if isinstance(array, Array) and isinstance(array.element, Quantity):
            return OperatorType(array.element)
        return fault(Fault.OPERANDS)
    faults = tuple(fault for value in values[1:] for fault in ordered(values[0], value).faults)
    unstated = Quantity(None) in values
    return OperatorType(Quantity(None) if unstated else values[0], faults)


def angle(value: Type) -> OperatorType:
    """An angle of an orientation."""
    fits = isinstance(value, Quaternion)
    return OperatorType(Quantity(parse_unit("rad"))) if fits else fault(Fault.OPERANDS)


def rate(value: Type) -> OperatorType:
    """The change of a number per second."""
    if not isinstance(value, Quantity):
        return _unfit(value)
    unit = value.unit and divide(unit_of_differences(value.unit), parse_unit("s"))
    return OperatorType(Quantity(unit))


def previous(value: Type) -> OperatorType:
    """The previous value of a number or vector."""
    return OperatorType(value) if isinstance(value, (Quantity, Vector)) else _unfit(value)


def filtered(value: Type, window: Type) -> OperatorType:
    """A number, smoothed over a window of time."""
    if not isinstance(value, Quantity):
        return _unfit(value)
    return OperatorType(value, ordered(window, _SECONDS).faults)


def changed(value: Type) -> OperatorType:
    """Say whether a value has changed."""
    if isinstance(value, (Quantity, Vector, Boolean)):
        return OperatorType(Boolean())
    return _unfit(value)


def age(_value: Type) -> OperatorType:
    """The time since the last message."""
    return OperatorType(_SECONDS)


def oscillating(value: Type, window: Type, *swing: Type) -> OperatorType:
    """Say whether a number oscillates."""
    if not isinstance(value, Quantity):
        return _unfit(value)
    faults = [fault for width in swing for fault in ordered(value, width).faults]
    return OperatorType(Boolean(), (*faults, *ordered(window, _SECONDS).faults))
