"""Frequencies: constant numbers in Hz above zero."""

from __future__ import annotations

from rossmarie.check.expressions.errors import NotAFrequency, NotPositive
from rossmarie.check.operations.operands import require_constant
from rossmarie.check.scopes.context import Context
from rossmarie.check.units.quantities import unit_behind
from rossmarie.check.wording.describe import describe, is_plain
from rossmarie.syntax import ast
from rossmarie.types import Quantity, Type, Unknown
from rossmarie.units import DIMENSIONLESS, parse_unit

_HERTZ = parse_unit("Hz")


def is_frequency(rate: ast.Expression, type_: Type, number: Type, context: Context) -> bool:
    """Say whether a rate of this type is a constant frequency above zero. Report an error if it is
    not. `number` is the type itself, or the type of its elements.
    """
    if isinstance(type_, Unknown):
        return False
    if not isinstance(number, Quantity) or (number.unit or DIMENSIONLESS).dimension != (
        _HERTZ.dimension
    ):
        fix = unit_behind(rate, "Hz", context) if _is_plain_number(type_) else None
        finding = NotAFrequency(found=describe(type_))
        context.collector.add(finding.at(rate.span, fix=fix))
        return False
    return require_constant(rate, "a rate", context) and is_positive(rate, "a rate", context)


def _is_plain_number(type_: object) -> bool:
    return isinstance(type_, Quantity) and is_plain(type_)


def is_positive(node: ast.Expression, what: str, context: Context) -> bool:
    """Say whether a constant is above zero. Report an error if it is not."""
    if context.values[node].numbers[0] > 0:
        return True
    finding = NotPositive(what=what, bound="more than zero", found="not")
    context.collector.add(finding.at(node.span, help=finding.AboveZero()))
    return False
