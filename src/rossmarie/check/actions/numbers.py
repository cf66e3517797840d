"""The numbers of effects: their fit to their fields, ramps, rates and times."""

from __future__ import annotations

from dslkit.diagnostics import Remark
from rossmarie.check.actions.errors import FieldUnitMismatch
from rossmarie.check.actions.paths import EffectField, describe_field
from rossmarie.check.expressions.errors import NotPositive
from rossmarie.check.expressions.frequencies import is_frequency
from rossmarie.check.expressions.infer import infer
from rossmarie.check.operations.operands import duration_ns
from rossmarie.check.scopes.context import Context
from rossmarie.check.units.quantities import ANGLE, unit_behind
from rossmarie.check.wording.describe import describe_quantity, is_plain
from rossmarie.syntax import ast
from rossmarie.types import Quantity
from rossmarie.units import DIMENSIONLESS

_FASTEST_HZ = 1000.0
_USUAL_TIMEOUT_NS = 2_000_000_000


def fits(node: ast.Expression, found: Quantity, field: EffectField, context: Context) -> bool:
    """Say whether numbers have the dimension of a field. Report an error if they do not."""
    if found.unit is None:
        return True
    expected = field.unit or DIMENSIONLESS
    if found.unit.dimension == expected.dimension:
        return True
    finding = FieldUnitMismatch(
        field=field.text, found=describe_quantity(found), expected=describe_field(field)
    )
    help: Remark = finding.Unit(unit=expected.symbol)
    fix = None
    if field.unit is None:
        help = finding.Unknown(field=field.text, unit=found.unit.symbol)
    elif is_plain(found) and expected.dimension != ANGLE:
        fix = unit_behind(node, expected.symbol, context)
    elif is_plain(found):
        help = finding.Angle()
    elif expected == DIMENSIONLESS:
        help = finding.NoUnit()
    context.collector.add(finding.at(node.span, help=help, fix=fix))
    return False


def period_ns(rate: ast.Expression, context: Context) -> int | None:
    """The time between two messages in ns; None, after reporting, if `rate` is not a possible
    frequency.
    """
    type_ = infer(rate, context)
    if not is_frequency(rate, type_, type_, context):
        return None
    hertz = context.values[rate].numbers[0]
    if hertz > _FASTEST_HZ or round(1e9 / hertz) > 10**18:
        is_fast = hertz > _FASTEST_HZ
        bound = "at most 1000 Hz" if is_fast else "at least 1e-9 Hz"
        finding = NotPositive(what="a rate", bound=bound, found=f"{hertz:g} Hz")
        help = finding.LessOften() if is_fast else finding.MoreOften()
        context.collector.add(finding.at(rate.span, help=help))
        return None
    return round(1e9 / hertz)


def timeout_ns(timeout: ast.Expression | None, context: Context) -> int | None:
    """The time limit in ns, 2 s if none is given; None, after reporting, if the limit is not a
    time.
    """
    if timeout is None:
        return _USUAL_TIMEOUT_NS
    infer(timeout, context)
    return duration_ns(timeout, "the time after `within`", context)
