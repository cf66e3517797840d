"""The numbers of effects: whether they fit the field that they are for, ramps, rates and times."""

from __future__ import annotations

from dslkit.diagnostics import Edit, Fix
from dslkit.source import Span
from rossmarie.check.action_errors import FieldUnitMismatch, NotAFrequency, NotPositive
from rossmarie.check.context import Context
from rossmarie.check.describe import describe, describe_quantity, is_plain
from rossmarie.check.expressions import infer
from rossmarie.check.operands import duration_ns, require_constant
from rossmarie.check.paths import Field, describe_field
from rossmarie.check.trees import literal_of, stripped
from rossmarie.check.units import ANGLE
from rossmarie.syntax import ast
from rossmarie.types import Quantity, Type, Unknown
from rossmarie.units import DIMENSIONLESS, parse_unit

_HERTZ = parse_unit("Hz")
_FASTEST_HZ = 1000.0
_USUAL_TIMEOUT_NS = 2_000_000_000


def fits(node: ast.Expression, found: Quantity, field: Field, context: Context) -> bool:
    """Whether numbers have the dimension of a field; reports it if not."""
    if found.unit is None:
        return True
    expected = field.unit or DIMENSIONLESS
    if found.unit.dimension == expected.dimension:
        return True
    advice = f"write it in {expected.symbol}"
    fix = None
    if field.unit is None:
        advice = (
            "leave the unit out: the number is sent as it is; or say in a system model which unit "
            f"the field has, `unit PACKAGE/TYPE.{field.text} = {found.unit.symbol};`"
        )
    elif is_plain(found) and expected.dimension != ANGLE:
        fix = _with_unit(node, expected.symbol, context)
    elif is_plain(found):
        advice = "write it in deg or rad"
    elif expected == DIMENSIONLESS:
        advice = "leave the unit out"
    finding = FieldUnitMismatch(
        field=field.text,
        found=describe_quantity(found),
        expected=describe_field(field),
        advice=advice,
    )
    context.collector.add(finding.at(node.span, fix=fix))
    return False


def _with_unit(node: ast.Expression, symbol: str, context: Context) -> Fix | None:
    """The fix that writes a unit behind a literal that stands here and has none."""
    literal = literal_of(node, context.declarations)
    if literal is None or literal.unit is not None or literal is not stripped(node):
        return None
    behind = Span(literal.span.file, literal.span.end, literal.span.end)
    return Fix(f"write `{symbol}` behind it", (Edit(behind, f" {symbol}"),))


def is_positive(node: ast.Expression, what: str, context: Context) -> bool:
    """Whether a constant is above zero; reports it if not."""
    if context.values[id(node)].numbers[0] > 0:
        return True
    finding = NotPositive(
        what=what, bound="more than zero", found="not", advice="write a number above zero"
    )
    context.collector.add(finding.at(node.span))
    return False


def period_ns(rate: ast.Expression, context: Context) -> int | None:
    """The time between two messages; None, after reporting, if `rate` is no possible frequency."""
    type_ = infer(rate, context)
    if not is_frequency(rate, type_, type_, context):
        return None
    hertz = context.values[id(rate)].numbers[0]
    if hertz > _FASTEST_HZ or round(1e9 / hertz) > 10**18:
        bound, advice = "at most 1000 Hz", "publish less often, or once: leave `at` out"
        if hertz <= _FASTEST_HZ:
            bound, advice = "at least 1e-9 Hz", "publish more often, or once: leave `at` out"
        too_fast = NotPositive(what="a rate", bound=bound, found=f"{hertz:g} Hz", advice=advice)
        context.collector.add(too_fast.at(rate.span))
        return None
    return round(1e9 / hertz)


def is_frequency(rate: ast.Expression, type_: Type, number: Type, context: Context) -> bool:
    """Whether a rate of this type is a constant frequency above zero; reports it if not. `number`
    is the type itself, or that of its elements.
    """
    if isinstance(type_, Unknown):
        return False
    if not isinstance(number, Quantity) or (number.unit or DIMENSIONLESS).dimension != (
        _HERTZ.dimension
    ):
        fix = _with_unit(rate, "Hz", context) if _is_plain_number(type_) else None
        finding = NotAFrequency(found=describe(type_))
        context.collector.add(finding.at(rate.span, fix=fix))
        return False
    return require_constant(rate, "a rate", context) and is_positive(rate, "a rate", context)


def _is_plain_number(type_: object) -> bool:
    return isinstance(type_, Quantity) and is_plain(type_)


def timeout_ns(timeout: ast.Expression | None, context: Context) -> int | None:
    """The time within which something has to be done, 2 s if nothing is said; None, after
    reporting, if it is no time.
    """
    if timeout is None:
        return _USUAL_TIMEOUT_NS
    infer(timeout, context)
    return duration_ns(timeout, "what stands after `within`", context)
