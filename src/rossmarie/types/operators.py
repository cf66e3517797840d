"""The one table of operators and built-in functions: what types they take, and what they give.

Operands of type `Unknown` make the result `Unknown` and are no fault. Operators that work on
numbers or booleans work on arrays of them element by element. Whether arguments are constant, or
inputs, or of the same array, is not a matter of types and left to the checker.
"""

from __future__ import annotations

import enum
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

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


class Operator(enum.Enum):
    """All operators and functions; the value is the spelling (of `-x`: `negate`)."""

    OR = "or"
    AND = "and"
    NOT = "not"
    EQUAL = "=="
    NOT_EQUAL = "!="
    LESS = "<"
    LESS_OR_EQUAL = "<="
    GREATER = ">"
    GREATER_OR_EQUAL = ">="
    IN = "in"
    FOR = "for"
    ADD = "+"
    SUBTRACT = "-"
    MULTIPLY = "*"
    DIVIDE = "/"
    NEGATE = "negate"
    ABS = "abs"
    NORM = "norm"
    HYPOT = "hypot"
    MIN = "min"
    MAX = "max"
    ANY = "any"
    ALL = "all"
    COUNT = "count"
    ROLL = "roll"
    PITCH = "pitch"
    YAW = "yaw"
    DISTANCE = "distance"
    STOPPING = "stopping"
    RATE = "rate"
    PREVIOUS = "previous"
    MEDIAN = "median"
    MEAN = "mean"
    LOW_PASS = "low_pass"
    CHANGED = "changed"
    AGE = "age"
    OSCILLATES = "oscillates"


class Fault(enum.Enum):
    """Why an operator cannot be applied to its operands."""

    OPERANDS = "the operator does not take operands of such types"
    VECTOR = "a vector stands where a single number is needed"
    RANGE = "an interval or box stands where a single number is needed"
    NOT_A_RANGE = "what follows `in` is a single number"
    UNITS = "the dimensions of the units differ"
    UNSTATED_UNIT = "one operand has a unit and that of the other, a message field, is not known"
    TEMPERATURE = "a temperature in degC is no amount that can be added, scaled or negated"


@dataclass(frozen=True)
class Outcome:
    """The type of the result, and what is wrong with the operands; with faults it is `Unknown`."""

    type: Type
    faults: tuple[Fault, ...] = ()


Rule = Callable[..., Outcome]
"""From the types of the operands, of which none is `Unknown`."""


@dataclass(frozen=True)
class Signature:
    """The number of operands that there may be (`most` None: any), and what becomes of them."""

    least: int
    most: int | None
    rule: Rule


def apply(operator: Operator, *operands: Type) -> Outcome:
    """The outcome of an operator; `SIGNATURES` says how many operands it takes.

    `oscillates` takes the value, the window and perhaps the swing; `for` a condition and a
    duration. Raises `TypeError` if there are too few or too many operands.
    """
    signature = SIGNATURES[operator]
    most = len(operands) if signature.most is None else signature.most
    if not signature.least <= len(operands) <= most:
        raise TypeError(f"{operator.value}: {len(operands)} operands")
    if any(isinstance(operand, Unknown) for operand in operands):
        return _absorbed(operator, operands)
    outcome = signature.rule(*operands)
    return _fault(*dict.fromkeys(outcome.faults)) if outcome.faults else outcome


def _absorbed(operator: Operator, operands: tuple[Type, ...]) -> Outcome:
    """`and` and `or` do not depend on the unknown operand, so the others are still looked at."""
    known = [operand for operand in operands if not isinstance(operand, Unknown)]
    if operator in (Operator.AND, Operator.OR):
        return _fault(
            *(fault for operand in known for fault in apply(Operator.NOT, operand).faults)
        )
    return _fault()


def unit_faults(left: Quantity, right: Quantity) -> tuple[Fault, ...]:
    """The reasons why two numbers may not be compared. A number of unstated unit goes with plain
    numbers.
    """
    if left.unit is None or right.unit is None:
        other = left.unit or right.unit or DIMENSIONLESS
        return () if other.dimension == DIMENSIONLESS.dimension else (Fault.UNSTATED_UNIT,)
    return () if left.unit.dimension == right.unit.dimension else (Fault.UNITS,)


def _fault(*faults: Fault) -> Outcome:
    return Outcome(Unknown(), faults)


def _unfit(*operands: Type) -> Outcome:
    """The finding on operands of which at least one is no number."""
    if any(isinstance(operand, (Interval, Box)) for operand in operands):
        return _fault(Fault.RANGE)
    numbers = all(isinstance(operand, (Vector, Quantity)) for operand in operands)
    return _fault(Fault.VECTOR if numbers else Fault.OPERANDS)


def _elementwise(rule: Rule, *operands: Type) -> Outcome:
    """The outcome for arrays that follows from a rule for scalars."""
    if not any(isinstance(operand, Array) for operand in operands):
        return rule(*operands)
    elements = (operand.element if isinstance(operand, Array) else operand for operand in operands)
    outcome = rule(*elements)
    if isinstance(outcome.type, (Quantity, Boolean)):
        return Outcome(Array(outcome.type), outcome.faults)
    return _fault(*(outcome.faults or (Fault.OPERANDS,)))


# --- booleans --------------------------------------------------------------------------------


def _logical(*operands: Type) -> Outcome:
    fits = all(isinstance(operand, Boolean) for operand in operands)
    return Outcome(Boolean()) if fits else _fault(Fault.OPERANDS)


def _held(condition: Type, duration: Type) -> Outcome:
    faults = (*_logical(condition).faults, *_ordered(duration, _SECONDS).faults)
    return Outcome(Boolean(), faults)


def _fold(result: Type, elements: Type) -> Outcome:
    """`any`, `all` and `count` of the truths of an array."""
    fits = isinstance(elements, Array) and isinstance(elements.element, Boolean)
    return Outcome(result) if fits else _fault(Fault.OPERANDS)


# --- comparison ------------------------------------------------------------------------------


def _ordered(left: Type, right: Type) -> Outcome:
    if isinstance(left, Quantity) and isinstance(right, Quantity):
        return Outcome(Boolean(), unit_faults(left, right))
    if isinstance(left, Vector) and isinstance(right, Quantity):
        return _fault(Fault.VECTOR, *unit_faults(left.element, right))
    if isinstance(left, Quantity) and isinstance(right, Vector):
        return _fault(Fault.VECTOR, *unit_faults(left, right.element))
    return _unfit(left, right)


def _equal(left: Type, right: Type) -> Outcome:
    for kind in (Boolean, Text):
        if isinstance(left, kind) and isinstance(right, kind):
            return Outcome(Boolean())
    return _ordered(left, right)


def _contained(value: Type, container: Type) -> Outcome:
    if isinstance(container, Quantity):
        return _fault(Fault.NOT_A_RANGE, *_ordered(value, container).faults)
    if isinstance(container, Interval) and isinstance(value, (Quantity, Vector)):
        return _ordered(value, container.element)
    if isinstance(container, Box) and isinstance(value, Vector):
        return Outcome(Boolean(), unit_faults(value.element, container.element))
    if isinstance(container, Region) and container.has_area:
        return Outcome(Boolean(), faults_of_position(value))
    return _fault(Fault.OPERANDS)


# --- arithmetic ------------------------------------------------------------------------------


def _additive(unit_rule: Callable[[Unit, Unit], Unit | None], left: Type, right: Type) -> Outcome:
    """A sum or difference; `unit_rule` gives None where temperatures make no sense."""
    if isinstance(left, Vector) and isinstance(right, Vector):
        return _as_vector(_additive(unit_rule, left.element, right.element))
    if not (isinstance(left, Quantity) and isinstance(right, Quantity)):
        return _ordered(left, right)
    faults = unit_faults(left, right)
    if faults or left.unit is None or right.unit is None:
        return Outcome(Quantity(None), faults)
    unit = unit_rule(left.unit, right.unit)
    return _fault(Fault.TEMPERATURE) if unit is None else Outcome(Quantity(unit))


def _unit_of_sum(left: Unit, right: Unit) -> Unit | None:
    if left.offset and right.offset:
        return None
    return right if right.offset else left


def _unit_of_difference(left: Unit, right: Unit) -> Unit | None:
    if right.offset:
        return unit_of_differences(left) if left.offset else None
    return left


def _multiplicative(unit_rule: Callable[[Unit, Unit], Unit], left: Type, right: Type) -> Outcome:
    """A product or quotient; one with a factor of unstated unit is of unstated unit."""
    if not (isinstance(left, Quantity) and isinstance(right, Quantity)):
        return _unfit(left, right)
    if left.unit is None or right.unit is None:
        return Outcome(Quantity(None))
    if left.unit.offset or right.unit.offset:
        return _fault(Fault.TEMPERATURE)
    return Outcome(Quantity(unit_rule(left.unit, right.unit)))


def _product(left: Type, right: Type) -> Outcome:
    if isinstance(left, Vector) and isinstance(right, Quantity):
        return _as_vector(_multiplicative(multiply, left.element, right))
    if isinstance(left, Quantity) and isinstance(right, Vector):
        return _as_vector(_multiplicative(multiply, left, right.element))
    return _multiplicative(multiply, left, right)


def _quotient(left: Type, right: Type) -> Outcome:
    if isinstance(left, Vector) and isinstance(right, Quantity):
        return _as_vector(_multiplicative(divide, left.element, right))
    return _multiplicative(divide, left, right)


def _negative(value: Type) -> Outcome:
    return _as_vector(_magnitude(value.element)) if isinstance(value, Vector) else _magnitude(value)


def _magnitude(value: Type) -> Outcome:
    if not isinstance(value, Quantity):
        return _unfit(value)
    return _fault(Fault.TEMPERATURE) if value.unit and value.unit.offset else Outcome(value)


def _as_vector(outcome: Outcome) -> Outcome:
    if isinstance(outcome.type, Quantity) and not outcome.faults:
        return Outcome(Vector(outcome.type))
    return outcome


# --- functions -------------------------------------------------------------------------------


def _norm(value: Type) -> Outcome:
    return _magnitude(value.element) if isinstance(value, Vector) else _fault(Fault.OPERANDS)


def _hypot(left: Type, right: Type) -> Outcome:
    if isinstance(left, Quantity) and isinstance(right, Quantity):
        return _additive(lambda one, other: None if other.offset else one, left, right)
    return _unfit(left, right)


def _distance(left: Type, right: Type) -> Outcome:
    if isinstance(left, Vector) and isinstance(right, Vector):
        return _additive(_unit_of_difference, left.element, right.element)
    if isinstance(right, Region):
        return Outcome(_METRES, faults_of_position(left))
    return _fault(Fault.OPERANDS)


def _stopping(motion: Type, *speed: Type) -> Outcome:
    """The way on which a motion slows down to a speed, or stops."""
    if not isinstance(motion, Motion):
        return _fault(Fault.OPERANDS)
    faults = (fault for each in speed for fault in _ordered(each, _SPEED).faults)
    return Outcome(_METRES, tuple(faults))


def faults_of_position(value: Type) -> tuple[Fault, ...]:
    """What keeps something from being a point in a plane; a pose is one by its position."""
    position = value.fields.get("position") if isinstance(value, Message) else value
    is_position = isinstance(position, Vector) and not unit_faults(position.element, _METRES)
    return () if is_position else (Fault.OPERANDS,)


def _extreme(*values: Type) -> Outcome:
    """The least or greatest of one array, or of several scalars."""
    if len(values) == 1:
        (array,) = values
        if isinstance(array, Array) and isinstance(array.element, Quantity):
            return Outcome(array.element)
        return _fault(Fault.OPERANDS)
    faults = tuple(fault for value in values[1:] for fault in _ordered(values[0], value).faults)
    unstated = Quantity(None) in values
    return Outcome(Quantity(None) if unstated else values[0], faults)


def _angle(value: Type) -> Outcome:
    fits = isinstance(value, Quaternion)
    return Outcome(Quantity(parse_unit("rad"))) if fits else _fault(Fault.OPERANDS)


def _rate(value: Type) -> Outcome:
    if not isinstance(value, Quantity):
        return _unfit(value)
    unit = value.unit and divide(unit_of_differences(value.unit), parse_unit("s"))
    return Outcome(Quantity(unit))


def _previous(value: Type) -> Outcome:
    return Outcome(value) if isinstance(value, (Quantity, Vector)) else _unfit(value)


def _filtered(value: Type, window: Type) -> Outcome:
    if not isinstance(value, Quantity):
        return _unfit(value)
    return Outcome(value, _ordered(window, _SECONDS).faults)


def _changed(value: Type) -> Outcome:
    if isinstance(value, (Quantity, Vector, Boolean)):
        return Outcome(Boolean())
    return _unfit(value)


def _age(_value: Type) -> Outcome:
    return Outcome(_SECONDS)


def _oscillating(value: Type, window: Type, *swing: Type) -> Outcome:
    if not isinstance(value, Quantity):
        return _unfit(value)
    faults = [fault for width in swing for fault in _ordered(value, width).faults]
    return Outcome(Boolean(), (*faults, *_ordered(window, _SECONDS).faults))


_SECONDS = Quantity(parse_unit("s"))
_METRES = Quantity(parse_unit("m"))
_SPEED = Quantity(parse_unit("m/s"))
_COMPARISON = Signature(2, 2, partial(_elementwise, _ordered))
_EQUALITY = Signature(2, 2, partial(_elementwise, _equal))
_JUNCTION = Signature(2, 2, partial(_elementwise, _logical))

SIGNATURES: Mapping[Operator, Signature] = {
    Operator.OR: _JUNCTION,
    Operator.AND: _JUNCTION,
    Operator.NOT: Signature(1, 1, partial(_elementwise, _logical)),
    Operator.EQUAL: _EQUALITY,
    Operator.NOT_EQUAL: _EQUALITY,
    Operator.LESS: _COMPARISON,
    Operator.LESS_OR_EQUAL: _COMPARISON,
    Operator.GREATER: _COMPARISON,
    Operator.GREATER_OR_EQUAL: _COMPARISON,
    Operator.IN: Signature(2, 2, partial(_elementwise, _contained)),
    Operator.FOR: Signature(2, 2, _held),
    Operator.ADD: Signature(2, 2, partial(_elementwise, partial(_additive, _unit_of_sum))),
    Operator.SUBTRACT: Signature(
        2, 2, partial(_elementwise, partial(_additive, _unit_of_difference))
    ),
    Operator.MULTIPLY: Signature(2, 2, partial(_elementwise, _product)),
    Operator.DIVIDE: Signature(2, 2, partial(_elementwise, _quotient)),
    Operator.NEGATE: Signature(1, 1, partial(_elementwise, _negative)),
    Operator.ABS: Signature(1, 1, partial(_elementwise, _magnitude)),
    Operator.NORM: Signature(1, 1, _norm),
    Operator.HYPOT: Signature(2, 2, _hypot),
    Operator.MIN: Signature(1, None, _extreme),
    Operator.MAX: Signature(1, None, _extreme),
    Operator.ANY: Signature(1, 1, partial(_fold, Boolean())),
    Operator.ALL: Signature(1, 1, partial(_fold, Boolean())),
    Operator.COUNT: Signature(1, 1, partial(_fold, Quantity(DIMENSIONLESS))),
    Operator.ROLL: Signature(1, 1, _angle),
    Operator.PITCH: Signature(1, 1, _angle),
    Operator.YAW: Signature(1, 1, _angle),
    Operator.DISTANCE: Signature(2, 2, _distance),
    Operator.STOPPING: Signature(1, 2, _stopping),
    Operator.RATE: Signature(1, 1, _rate),
    Operator.PREVIOUS: Signature(1, 1, _previous),
    Operator.MEDIAN: Signature(2, 2, _filtered),
    Operator.MEAN: Signature(2, 2, _filtered),
    Operator.LOW_PASS: Signature(2, 2, _filtered),
    Operator.CHANGED: Signature(1, 1, _changed),
    Operator.AGE: Signature(1, 1, _age),
    Operator.OSCILLATES: Signature(2, 3, _oscillating),
}
