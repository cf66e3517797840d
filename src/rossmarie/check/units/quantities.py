"""The rules of units: the quantities that fit together, and the meaning of a written unit."""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.diagnostics import (
    Collector,
    DeclaredHere,
    DidYouMean,
    Edit,
    Fix,
    Label,
    NamedHere,
    Remark,
)
from dslkit.source import Span
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import (
    constant_of,
    literal_of,
    path_of,
    root_of,
    stripped,
    text_of,
)
from rossmarie.check.units.errors import (
    FieldWithoutUnit,
    InUnit,
    MissingUnit,
    OfField,
    OfUnknownUnit,
    PlainNumber,
    RateAgainstQuantity,
    UnitMismatch,
    UnknownUnit,
)
from rossmarie.check.wording.describe import describe_quantity, is_plain
from rossmarie.syntax import ast
from rossmarie.types import Array, Box, Interval, Quantity, Vector, unit_faults
from rossmarie.units import (
    DIMENSIONLESS,
    Unit,
    UnknownUnitError,
    divide,
    factor_of,
    multiply,
    parse_unit,
)

SECOND = parse_unit("s")
ANGLE = parse_unit("rad").dimension
_GRAM = parse_unit("g")
_GRAVITY = parse_unit("g0")


@dataclass(frozen=True)
class CheckedOperand:
    """A number in an expression, or the numbers in a vector, an array or a range."""

    node: ast.Expression
    quantity: Quantity


def operand_of(node: ast.Expression, context: Context) -> CheckedOperand | None:
    """The quantity of a number, or of the numbers in a composite value; None if there are none."""
    type_ = context.type_of(node)
    if isinstance(type_, Vector | Array | Interval | Box):
        element = type_.element
        return CheckedOperand(node, element) if isinstance(element, Quantity) else None
    return CheckedOperand(node, type_) if isinstance(type_, Quantity) else None


def read_unit(unit: ast.Unit, collector: Collector) -> Unit | None:
    """The unit; None after reporting that there is no such unit."""
    try:
        return parse_unit(unit.text)
    except UnknownUnitError as error:
        near = next(iter(error.suggestions), None)
        factor = factor_of(error.part)
        finding = UnknownUnit(text=error.text, part=error.part)
        help: Remark
        if factor is not None:
            help, fix = finding.Factor(factor=factor), None
        elif near is None:
            help, fix = finding.Examples(), None
        else:
            help = DidYouMean(near=near)
            fix = Fix(f"write `{near}`", (Edit(unit.span, near),))
        collector.add(finding.at(unit.span, help=help, fix=fix))
        return None


def check_fit(
    first: CheckedOperand, second: CheckedOperand, purpose: str, context: Context
) -> bool:
    """Say whether two quantities can be `purpose` (compared, added ...). Report an error if they
    cannot.
    """
    if not unit_faults(first.quantity, second.quantity):
        return True
    odd, other = _odd_one(first, second, context)
    if odd.quantity.unit is None or other.quantity.unit is None:
        unknown, known = (odd, other) if odd.quantity.unit is None else (other, odd)
        _report_field_without_unit(unknown, known, context)
    elif is_plain(odd.quantity) and odd.node in context.values:
        _report_missing_unit(odd, other, context)
    elif is_plain(other.quantity) and other.node in context.values:
        _report_missing_unit(other, odd, context)
    else:
        _report_mismatch(odd, other, purpose, context)
    return False


def check_fit_of(
    first: ast.Expression, second: ast.Expression, purpose: str, context: Context
) -> None:
    """Apply `check_fit` to the numbers in two expressions, if both have numbers."""
    left, right = operand_of(first, context), operand_of(second, context)
    if left is not None and right is not None:
        check_fit(left, right, purpose, context)


def _odd_one(
    first: CheckedOperand, second: CheckedOperand, context: Context
) -> tuple[CheckedOperand, CheckedOperand]:
    """The operand at fault: the constant operand, or else the second."""
    if first.node in context.values and second.node not in context.values:
        return first, second
    return second, first


def _report_mismatch(
    odd: CheckedOperand, other: CheckedOperand, purpose: str, context: Context
) -> None:
    found, expected = odd.quantity.unit, other.quantity.unit
    if found is None or expected is None:
        return
    labels = (*_labels(odd, context), _is_in(other), *_labels(other, context))
    if _is_rate_of(found, expected) or _is_rate_of(expected, found):
        _report_rate(odd, other, labels, context)
        return
    finding = UnitMismatch(
        found=describe_quantity(odd.quantity),
        words=_is_in(odd).text,
        expected=describe_quantity(other.quantity),
        purpose=purpose,
    )
    help: Remark | None = finding.NoUnit() if is_plain(other.quantity) else None
    fix = None
    if found == _GRAM and expected.dimension == _GRAVITY.dimension:
        help = finding.Gram(gram=found.symbol, gravity=_GRAVITY.symbol)
        fix = _unit_fix(odd, _GRAVITY, context)
    context.collector.add(finding.at(odd.node.span, *labels, help=help, fix=fix))


def _report_rate(
    odd: CheckedOperand, other: CheckedOperand, labels: tuple[Label, ...], context: Context
) -> None:
    found, expected = odd.quantity.unit, other.quantity.unit
    if found is None or expected is None:
        return
    rate, quantity = (odd, other) if _is_rate_of(found, expected) else (other, odd)
    finding = RateAgainstQuantity(
        rate=describe_quantity(rate.quantity),
        quantity=describe_quantity(quantity.quantity),
        words=_is_in(odd).text,
        expected=expected.symbol,
    )
    meant = _meant_unit(found, expected)
    help: Remark = finding.Unit(unit=meant.symbol)
    is_changing = quantity.node not in context.values
    if is_changing and isinstance(context.type_of(quantity.node), Quantity):
        help = finding.UnitOrRate(unit=meant.symbol, text=text_of(quantity.node))
    fix = _unit_fix(odd, meant, context)
    context.collector.add(finding.at(odd.node.span, *labels, help=help, fix=fix))


def _meant_unit(found: Unit, expected: Unit) -> Unit:
    """The unit `found` with or without its time: deg/s for deg, if rad/s is expected."""
    is_rate = _is_rate_of(found, expected)
    meant = multiply(found, SECOND) if is_rate else divide(found, SECOND)
    is_simple = "*" not in meant.symbol or "*" in expected.symbol
    return meant if is_simple else expected


def _unit_fix(odd: CheckedOperand, unit: Unit, context: Context) -> Fix | None:
    number = literal_of(odd.node, context.declarations)
    if number is None or number.unit is None:
        return None
    kept = number.span.file.text[number.span.start : number.unit.span.start]
    return Fix(f"write `{kept}{unit.symbol}`", (Edit(number.unit.span, unit.symbol),))


def _report_missing_unit(plain: CheckedOperand, other: CheckedOperand, context: Context) -> None:
    unit = other.quantity.unit or DIMENSIONLESS
    number = literal_of(plain.node, context.declarations)
    if number is None or number.unit is not None:
        corrected, fix = f"({text_of(plain.node)}) * 1 {unit.symbol}", None
    else:
        corrected = f"{text_of(number)} {unit.symbol}"
        behind = Span(number.span.file, number.span.end, number.span.end)
        fix = Fix(f"write `{corrected}`", (Edit(behind, f" {unit.symbol}"),))
    is_angle = unit.dimension == ANGLE
    if is_angle and number is not None and number.unit is None:
        # Only the user knows the right unit; a wrong one would be off by a factor of 57.
        corrected, fix = f"{text_of(number)} deg` or `{text_of(number)} rad", None
    finding = MissingUnit(
        expected=unit.symbol,
        dimension=str(unit.dimension),
        reason="a plain number is not an angle"
        if is_angle
        else "a plain number could have any unit",
        corrected=corrected,
    )
    labels = (*_labels(plain, context), _is_in(other), *_labels(other, context))
    context.collector.add(finding.at(plain.node.span, *labels, fix=fix))


def _report_field_without_unit(
    unknown: CheckedOperand, known: CheckedOperand, context: Context
) -> None:
    unit = (known.quantity.unit or DIMENSIONLESS).symbol
    finding = FieldWithoutUnit(other=unit)
    labels = (_is_in(known), *_labels(known, context))
    root = root_of(unknown.node)
    found = context.inputs.get(root.name.text) if root is not None else None
    if found is None:
        known_unit = finding.KnownUnit(unit=unit)
        context.collector.add(finding.at(unknown.node.span, *labels, help=known_unit))
    elif isinstance(found.type, Quantity | Vector | Array):
        declaration = found.declaration
        place = end_of_field(declaration)
        labels = (*labels, DeclaredHere().at(declaration.name.span))
        fix = Fix(f"declare that it arrives in {unit}", (Edit(place, f" in {unit}"),))
        context.collector.add(finding.at(unknown.node.span, *labels, fix=fix))
    else:
        field = ".".join((found.message_type, *found.path, *path_of(unknown.node)))
        help = finding.InSystemModel(field=field, unit=unit)
        context.collector.add(finding.at(unknown.node.span, *labels, help=help))


def unit_behind(node: ast.Expression, symbol: str, context: Context) -> Fix | None:
    """The fix that adds a unit to a literal without one."""
    literal = literal_of(node, context.declarations)
    if literal is None or literal.unit is not None or literal is not stripped(node):
        return None
    behind = Span(literal.span.file, literal.span.end, literal.span.end)
    return Fix(f"write `{symbol}` after it", (Edit(behind, f" {symbol}"),))


def is_same_unit(unit: Unit, other: Unit) -> bool:
    """Say whether two units are the same under different names, such as `s` and `sec`."""
    return (unit.dimension, unit.scale, unit.offset) == (
        other.dimension,
        other.scale,
        other.offset,
    )


def end_of_field(declaration: ast.Input) -> Span:
    """The empty place after the topic, type, path, names and bound of an input, where the unit
    belongs.
    """
    last = (declaration.message_type or declaration.topic).span
    if declaration.path:
        last = declaration.path[-1].span
    if declaration.names is not None:
        last = declaration.names.span
    if declaration.bound is not None:
        last = declaration.bound.span
    return Span(last.file, last.end, last.end)


def _is_rate_of(rate: Unit, quantity: Unit) -> bool:
    return divide(quantity, SECOND).dimension == rate.dimension


def _is_in(operand: CheckedOperand) -> Label:
    if operand.quantity.unit is None:
        return OfUnknownUnit().at(operand.node.span)
    if is_plain(operand.quantity):
        return PlainNumber().at(operand.node.span)
    unit = operand.quantity.unit
    return InUnit(unit=unit.symbol, dimension=str(unit.dimension)).at(operand.node.span)


def _labels(operand: CheckedOperand, context: Context) -> tuple[Label, ...]:
    """The label for the origin of an operand's unit, if it is in another place."""
    constant = constant_of(stripped(operand.node), context.declarations)
    if constant is not None:
        return (NamedHere(name=constant.name.text).at(constant.value.span),)
    root = root_of(operand.node)
    found = context.inputs.get(root.name.text) if root is not None else None
    if found is None:
        return ()
    declaration = found.declaration
    place = declaration.topic.span.to(end_of_field(declaration))
    field = found.field
    return (OfField(name=declaration.name.text, field=field).at(place),)
