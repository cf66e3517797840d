"""The one table of operators and built-in functions, with their operand and result types.

Operands of type `Unknown` make the result `Unknown` and are not errors. Operators on numbers or
booleans work on arrays element by element. Types do not show whether arguments are constants,
inputs, or elements of the same array; the checker tests this.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

from rossmarie.types import rules
from rossmarie.types.model import Boolean, Quantity, Type, Unknown
from rossmarie.types.rules import OperatorType, Rule
from rossmarie.units import DIMENSIONLESS


class Operator(enum.Enum):
    """All operators and functions; the value is the spelling (for `-x`: `negate`)."""

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
    SIN = "sin"
    COS = "cos"
    ROLL = "roll"
    PITCH = "pitch"
    YAW = "yaw"
    DISTANCE = "distance"
    STOPPING = "stopping"
    BRAKING_DISTANCE = "braking_distance"
    TIME_TO = "time_to"
    RATE = "rate"
    PREVIOUS = "previous"
    MEDIAN = "median"
    MEAN = "mean"
    LOW_PASS = "low_pass"
    CHANGED = "changed"
    AGE = "age"
    OSCILLATES = "oscillates"


@dataclass(frozen=True)
class Signature:
    """The least and the greatest number of operands (`most` None: any), and the rule for their
    types.
    """

    least: int
    most: int | None
    rule: Rule


def apply(operator: Operator, *operands: Type) -> OperatorType:
    """The outcome of an operator; `SIGNATURES` contains its number of operands.

    `oscillates` takes the value, the window and optionally the swing; `for` takes a condition and a
    duration. Raises `TypeError` if there are too few or too many operands.
    """
    signature = SIGNATURES[operator]
    most = len(operands) if signature.most is None else signature.most
    if not signature.least <= len(operands) <= most:
        raise TypeError(f"{operator.value}: {len(operands)} operands")
    if any(isinstance(operand, Unknown) for operand in operands):
        return _absorbed(operator, operands)
    outcome = signature.rule(*operands)
    return rules.fault(*dict.fromkeys(outcome.faults)) if outcome.faults else outcome


def _absorbed(operator: Operator, operands: tuple[Type, ...]) -> OperatorType:
    """The outcome of `and` and `or` with an unknown operand: the other operands are still
    checked.
    """
    known = [operand for operand in operands if not isinstance(operand, Unknown)]
    if operator in (Operator.AND, Operator.OR):
        return rules.fault(
            *(fault for operand in known for fault in apply(Operator.NOT, operand).faults)
        )
    return rules.fault()


_COMPARISON = Signature(2, 2, partial(rules.elementwise, rules.ordered))
_EQUALITY = Signature(2, 2, partial(rules.elementwise, rules.equal))
_JUNCTION = Signature(2, 2, partial(rules.elementwise, rules.logical))

SIGNATURES: Mapping[Operator, Signature] = {
    Operator.OR: _JUNCTION,
    Operator.AND: _JUNCTION,
    Operator.NOT: Signature(1, 1, partial(rules.elementwise, rules.logical)),
    Operator.EQUAL: _EQUALITY,
    Operator.NOT_EQUAL: _EQUALITY,
    Operator.LESS: _COMPARISON,
    Operator.LESS_OR_EQUAL: _COMPARISON,
    Operator.GREATER: _COMPARISON,
    Operator.GREATER_OR_EQUAL: _COMPARISON,
    Operator.IN: Signature(2, 2, partial(rules.elementwise, rules.contained)),
    Operator.FOR: Signature(2, 2, rules.held),
    Operator.ADD: Signature(
        2, 2, partial(rules.elementwise, partial(rules.additive, rules.unit_of_sum))
    ),
    Operator.SUBTRACT: Signature(
        2, 2, partial(rules.elementwise, partial(rules.additive, rules.unit_of_difference))
    ),
    Operator.MULTIPLY: Signature(2, 2, partial(rules.elementwise, rules.product)),
    Operator.DIVIDE: Signature(2, 2, partial(rules.elementwise, rules.quotient)),
    Operator.NEGATE: Signature(1, 1, partial(rules.elementwise, rules.negative)),
    Operator.ABS: Signature(1, 1, partial(rules.elementwise, rules.magnitude)),
    Operator.NORM: Signature(1, 1, rules.norm),
    Operator.HYPOT: Signature(2, 2, rules.hypot),
    Operator.MIN: Signature(1, None, rules.extreme),
    Operator.MAX: Signature(1, None, rules.extreme),
    Operator.ANY: Signature(1, 1, partial(rules.fold, Boolean())),
    Operator.ALL: Signature(1, 1, partial(rules.fold, Boolean())),
    Operator.COUNT: Signature(1, 1, partial(rules.fold, Quantity(DIMENSIONLESS))),
    Operator.SIN: Signature(1, 1, rules.wave),
    Operator.COS: Signature(1, 1, rules.wave),
    Operator.ROLL: Signature(1, 1, rules.angle),
    Operator.PITCH: Signature(1, 1, rules.angle),
    Operator.YAW: Signature(1, 1, rules.angle),
    Operator.DISTANCE: Signature(2, 2, rules.distance),
    Operator.STOPPING: Signature(1, 2, rules.stopping),
    Operator.BRAKING_DISTANCE: Signature(3, 3, rules.braking_distance),
    Operator.TIME_TO: Signature(2, 2, rules.time_to),
    Operator.RATE: Signature(1, 1, rules.rate),
    Operator.PREVIOUS: Signature(1, 1, rules.previous),
    Operator.MEDIAN: Signature(2, 2, rules.filtered),
    Operator.MEAN: Signature(2, 2, rules.filtered),
    Operator.LOW_PASS: Signature(2, 2, rules.filtered),
    Operator.CHANGED: Signature(1, 1, rules.changed),
    Operator.AGE: Signature(1, 1, rules.age),
    Operator.OSCILLATES: Signature(2, 3, rules.oscillating),
}
