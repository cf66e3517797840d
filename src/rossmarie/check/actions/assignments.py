"""The fields of a message, request or goal that an effect sends, and their values."""

from __future__ import annotations

from collections.abc import Mapping

from dslkit.diagnostics import Remark
from rossmarie.check.actions.errors import FieldGivenTwice, FieldNotAssignable, ValueMismatch
from rossmarie.check.actions.numbers import fits
from rossmarie.check.actions.paths import EffectField, describe_field, field_of
from rossmarie.check.actions.targets import SentMessage, TargetResolver
from rossmarie.check.actions.whole_numbers import is_whole
from rossmarie.check.expressions.infer import infer
from rossmarie.check.operations.operands import require_constant
from rossmarie.check.scopes.context import Context
from rossmarie.check.units.errors import MisplacedUnit
from rossmarie.check.units.quantities import read_unit
from rossmarie.check.wording.describe import describe, is_plain
from rossmarie.ir import reactions
from rossmarie.syntax import ast
from rossmarie.types import Boolean, Message, Quantity, Text, Unknown
from rossmarie.units import DIMENSIONLESS, Unit

_INTEGERS: Mapping[str, tuple[int, int]] = {
    **{f"int{bits}": (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": (0, 2**bits - 1) for bits in (8, 16, 32, 64)},
    "byte": (0, 255),
    "octet": (0, 255),
    "char": (0, 255),
}


def assignments_of(
    written: tuple[ast.FieldAssignment, ...], sent: SentMessage | None, targets: TargetResolver
) -> tuple[reactions.Assignment, ...] | None:
    """The assigned values, in the units of the message; None after reporting an error."""
    found: list[reactions.Assignment] = []
    first: dict[reactions.FieldPath, ast.FieldAssignment] = {}
    is_right = sent is not None
    for assignment in written:
        field = None if sent is None else field_of(assignment.path, sent, targets)
        if field is None or not _is_assignable(field, assignment, targets.context):
            _infer_parts(assignment.value, targets.context)
            is_right = False
            continue
        earlier = first.setdefault(field.path, assignment)
        if earlier is not assignment:
            finding = FieldGivenTwice(field=field.text)
            place = finding.First().at(earlier.path.span)
            targets.context.collector.add(finding.at(assignment.path.span, place))
            is_right = False
        value = _value(assignment.value, field, targets.context)
        if value is None:
            is_right = False
        else:
            found.append(reactions.Assignment(field.path, value))
    return tuple(found) if is_right else None


def _infer_parts(value: ast.Expression, context: Context) -> None:
    """Infer the types of the names in a value whose expected type is unknown."""
    for part in _elements(value):
        infer(part, context)


def _elements(value: ast.Expression) -> tuple[ast.Expression, ...]:
    return value.elements if isinstance(value, ast.Bracket) else (value,)


def _is_assignable(field: EffectField, assignment: ast.FieldAssignment, context: Context) -> bool:
    kind = FieldNotAssignable
    help: Remark
    reason, help = "a message, not a value", kind.SomeField()
    if isinstance(field.type, Message) and field.leaf is None:
        inside = [f"`{field.text}.{name}`" for name in field.type.fields][:8]
        help = kind.Fields(fields=", ".join(inside)) if inside else help
    elif field.leaf is None:
        reason, help = "it is not a single number, boolean or string", kind.Scalars()
        if not isinstance(field.type, Quantity):
            help = kind.Part(field=field.text)
    elif field.leaf.is_array is field.is_element or not field.is_element:
        return True
    else:
        reason, help = "not an array", kind.NoIndex()
    finding = kind(field=field.text, reason=reason)
    context.collector.add(finding.at(assignment.path.span, help=help))
    return False


def _value(
    value: ast.Expression, field: EffectField, context: Context
) -> reactions.Scalar | tuple[reactions.Scalar, ...] | None:
    is_list = field.leaf is not None and field.leaf.is_array and not field.is_element
    if is_list != isinstance(value, ast.Bracket):
        _infer_parts(value, context)
        found = "a list" if isinstance(value, ast.Bracket) else "one value"
        expected = "a list, `[...]`" if is_list else "one value"
        finding = ValueMismatch(field=field.text, expected=expected, found=found)
        context.collector.add(finding.at(value.span))
        return None
    if not isinstance(value, ast.Bracket):
        return scalar(value, None, field, context)
    unit = None if value.unit is None else read_unit(value.unit, context.collector)
    is_wrong = value.unit is not None and unit is None
    if is_wrong or (unit is not None and not fits(value, Quantity(unit), field, context)):
        _infer_parts(value, context)
        return None
    scalars = [scalar(element, unit, field, context) for element in value.elements]
    known = tuple(each for each in scalars if each is not None)
    return known if len(known) == len(scalars) else None


def scalar(
    node: ast.Expression, unit: Unit | None, field: EffectField, context: Context
) -> reactions.Scalar | None:
    """A value in the unit of its field. `unit` is the unit of the list around the value. Returns
    None after reporting an error.
    """
    type_ = infer(node, context)
    if isinstance(type_, Unknown) or not require_constant(node, f"`{field.text}`", context):
        return None
    base = "" if field.leaf is None else field.leaf.base
    value = context.values[node]
    if isinstance(type_, Boolean) and base == "bool" and value.boolean is not None:
        return value.boolean
    if isinstance(type_, Text) and base in ("string", "wstring") and value.text is not None:
        return value.text
    if not isinstance(type_, Quantity) or base in ("bool", "string", "wstring"):
        expected = describe_field(field)
        expected = f"a number {expected}" if expected.startswith(("in ", "of ")) else expected
        finding = ValueMismatch(field=field.text, expected=expected, found=describe(type_))
        context.collector.add(finding.at(node.span))
        return None
    return _number(node, type_, unit, field, context)


def _number(
    node: ast.Expression, type_: Quantity, unit: Unit | None, field: EffectField, context: Context
) -> float | None:
    number = context.values[node].numbers[0]
    if unit is not None and not is_plain(type_):
        reason = "both this element and the whole list have a unit"
        twice = MisplacedUnit(reason=reason)
        help = twice.OnceInList(unit=unit.symbol)
        context.collector.add(twice.at(node.span, help=help))
        return None
    if unit is not None:
        number = unit.to_si(number)
    elif not fits(node, type_, field, context):
        return None
    limits = _INTEGERS.get("" if field.leaf is None else field.leaf.base)
    if limits and not is_whole(node, number, field.text, (field.unit, limits), context):
        return None
    found = (field.unit or DIMENSIONLESS).from_si(number) + 0.0
    return float(round(found)) if limits else found
