"""Operators: the results of the table of operators, and the findings for the errors of the
table.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from dslkit.diagnostics import Edit, Fix, Remark, Write
from rossmarie.check.names.frames import check_one_frame
from rossmarie.check.operations.angles import warn_of_difference
from rossmarie.check.operations.edges import type_of_edge_comparison
from rossmarie.check.operations.errors import (
    BooleanCompared,
    DivisionByZero,
    ExactEquality,
    Incomparable,
    StringsCompared,
    TemperatureArithmetic,
)
from rossmarie.check.operations.operands import (
    duration_ns,
    is_age,
    is_boolean,
    is_edge_count,
    report_misused_age,
    report_not_a_condition,
    report_not_a_number,
    report_uncompared,
)
from rossmarie.check.operations.raw_readings import warn_of_raw_reading
from rossmarie.check.operations.temporal import report_ambiguous
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import constant_of, quoted, stripped, text_of
from rossmarie.check.units.quantities import CheckedOperand, check_fit_of, operand_of
from rossmarie.check.units.ratios import check_ratio
from rossmarie.check.wording.describe import describe, is_plain
from rossmarie.syntax import ast
from rossmarie.types import (
    Boolean,
    Box,
    Fault,
    Interval,
    Operator,
    Text,
    Type,
    Unknown,
    Vector,
    apply,
)

LOGIC = frozenset({Operator.AND, Operator.OR, Operator.NOT})
EQUALITY = frozenset({Operator.EQUAL, Operator.NOT_EQUAL})
ARITHMETIC = frozenset(
    {Operator.ADD, Operator.SUBTRACT, Operator.MULTIPLY, Operator.DIVIDE, Operator.NEGATE}
)
ADDITIVE = frozenset({Operator.ADD, Operator.SUBTRACT})
PURPOSES: Mapping[Operator, str] = {
    Operator.ADD: "added",
    Operator.SUBTRACT: "subtracted",
}


def type_of_binary(node: ast.Binary, context: Context) -> Type:
    """The type of an infix expression whose operands have types."""
    operator = Operator(node.operator.value)
    if operator in LOGIC:
        report_ambiguous(node, context)
        return applied(operator, (node.left, node.right), context)
    if operator in ARITHMETIC:
        if operator is Operator.SUBTRACT:
            warn_of_difference(node, context)
        type_ = applied(operator, (node.left, node.right), context)
        if operator in ADDITIVE and not check_one_frame((node.left, node.right), context):
            return Unknown()
        is_by_zero = operator is Operator.DIVIDE and _is_zero(node.right, context)
        return Unknown() if is_by_zero else type_
    return _comparison(operator, node, context)


def type_of_unary(node: ast.Unary, context: Context) -> Type:
    """The type of `not x` and `-x`."""
    match node.operator:
        case ast.UnaryOperator.NOT:
            return applied(Operator.NOT, (node.operand,), context)
        case ast.UnaryOperator.NEGATE:
            return applied(Operator.NEGATE, (node.operand,), context)


def applied(operator: Operator, operands: Sequence[ast.Expression], context: Context) -> Type:
    """The type that an operator gives for its operands. Operands that do not fit are reported."""
    reason = "it is not one side of a comparison"
    if [operand for operand in operands if report_uncompared(operand, reason, context)]:
        return Unknown()
    outcome = apply(operator, *map(context.type_of, operands))
    for fault in outcome.faults:
        _report(fault, operator, operands, context)
    return outcome.type


def _report(
    fault: Fault, operator: Operator, operands: Sequence[ast.Expression], context: Context
) -> None:
    match fault:
        case Fault.UNITS | Fault.UNSTATED_UNIT:
            for other in operands[1:]:
                check_fit_of(operands[0], other, PURPOSES.get(operator, "compared"), context)
        case Fault.TEMPERATURE:
            _report_temperature(operands, context)
        case Fault.VECTOR:
            _report_those(Vector, operands, context)
        case Fault.RANGE:
            _report_those((Interval, Box), operands, context)
        case Fault.OPERANDS | Fault.NOT_A_RANGE:
            report = report_not_a_condition if operator in LOGIC else _report_if_not_a_number
            for operand in operands:
                report(operand, context)


def _report_those(
    kinds: type[object] | tuple[type[object], ...],
    operands: Sequence[ast.Expression],
    context: Context,
) -> None:
    for operand in operands:
        if isinstance(context.type_of(operand), kinds):
            report_not_a_number(operand, context)


def _report_if_not_a_number(node: ast.Expression, context: Context) -> None:
    if operand_of(node, context) is None:
        report_not_a_number(node, context)


def _report_temperature(operands: Sequence[ast.Expression], context: Context) -> None:
    for node in operands:
        operand = operand_of(node, context)
        unit = None if operand is None else operand.quantity.unit
        if unit is not None and unit.offset:
            context.collector.add(TemperatureArithmetic(unit=unit.symbol).at(node.span))


# --- comparison ------------------------------------------------------------------------------


def _comparison(operator: Operator, node: ast.Binary, context: Context) -> Type:
    if is_age(node.left) or is_age(node.right):
        return _age_comparison(operator, node, context)
    if is_edge_count(node.left) or is_edge_count(node.right):
        return type_of_edge_comparison(operator, node, context)
    left, right = context.type_of(node.left), context.type_of(node.right)
    if is_boolean(left) and is_boolean(right):
        return _boolean_comparison(operator, node, context)
    outcome = apply(operator, left, right)
    if isinstance(left, Text) and isinstance(right, Text) and not outcome.faults:
        return _text_comparison(node, context)
    if Fault.OPERANDS in outcome.faults and any(
        is_boolean(side) or isinstance(side, Text) for side in (left, right)
    ):
        return _report_incomparable(node, context)
    for fault in outcome.faults:
        _report(fault, operator, (node.left, node.right), context)
    if not outcome.faults and not check_one_frame((node.left, node.right), context):
        return Unknown()
    if not outcome.faults:
        check_ratio(node.left, node.right, context)
        check_ratio(node.right, node.left, context)
        warn_of_raw_reading(node, context)
    if operator in EQUALITY and not outcome.faults:
        _warn_of_equality(operator, node, context)
    return outcome.type


def _boolean_comparison(operator: Operator, node: ast.Binary, context: Context) -> Type:
    literal, other = stripped(node.right), node.left
    if not isinstance(literal, ast.Boolean):
        literal, other = stripped(node.left), node.right
    help, fix = None, None
    if isinstance(literal, ast.Boolean) and operator in EQUALITY:
        is_same = literal.value == (operator is Operator.EQUAL)
        meant = other.span.text if is_same else f"not ({other.span.text})"
        help = Write(meant=quoted(meant))
        fix = Fix(str(help), (Edit(node.span, meant),))
    finding = BooleanCompared(operator=operator.value)
    context.collector.add(finding.at(node.span, help=help, fix=fix))
    return Unknown()


def _text_comparison(node: ast.Binary, context: Context) -> Type:
    """The type of a comparison of texts. One side has to be known, because the compiler numbers
    texts.
    """
    if node.left in context.values or node.right in context.values:
        return Boolean()
    finding = StringsCompared(left=text_of(node.left), right=text_of(node.right))
    context.collector.add(finding.at(node.span))
    return Unknown()


def _report_incomparable(node: ast.Binary, context: Context) -> Type:
    left, right = (describe(context.type_of(side)) for side in (node.left, node.right))
    finding = Incomparable(left=left, right=right, operator=node.operator.value)
    help: Remark
    if left == right:
        help = finding.Strings()
    elif is_boolean(context.type_of(node.left)) or is_boolean(context.type_of(node.right)):
        help = finding.Boolean()
    else:
        help = _in_one_kind(node, context)
    context.collector.add(finding.at(node.span, help=help))
    return Unknown()


def _in_one_kind(node: ast.Binary, context: Context) -> Remark:
    """Show how to compare a text with a number."""
    for side in (node.left, node.right):
        literal, constant = stripped(side), constant_of(stripped(side), context.declarations)
        if constant is not None:
            what = describe(context.type_of(side))
            return Incomparable.Constant(constant=constant.name.text, what=what)
        if isinstance(literal, ast.Text) and _is_number(literal.value):
            return Incomparable.Quoted(number=literal.value)
        if isinstance(literal, ast.Number):
            return Incomparable.Unquoted(number=text_of(literal))
    return Incomparable.OfOneKind()


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def _warn_of_equality(operator: Operator, node: ast.Binary, context: Context) -> None:
    """Warn of an equality of numbers. Whole numbers without a unit are not reported, because most
    are states and counts.
    """
    sides = [operand_of(side, context) for side in (node.left, node.right)]
    numbers = [side for side in sides if side is not None]
    values = [context.values[side.node] for side in numbers if side.node in context.values]
    if len(numbers) < len(sides) or len(values) == len(sides):
        return
    if all(map(_has_no_unit, numbers)) and all(value.numbers[0].is_integer() for value in values):
        return
    sign = "<" if operator is Operator.EQUAL else ">"
    known = next((side for side in numbers if side.node in context.values), numbers[0])
    unit = known.quantity.unit
    step = "0.01" if unit is None or _has_no_unit(known) else f"0.01 {unit.symbol}"
    gap = f"{text_of(node.left)} - {text_of(node.right)}"
    if values and values[0].numbers == (0.0,):
        gap = text_of(next(side.node for side in numbers if side is not known))
    advice = f"abs({gap}) {sign} {step}"
    finding = ExactEquality(operator=operator.value, advice=advice)
    context.collector.add(finding.at(node.span))


def _has_no_unit(operand: CheckedOperand) -> bool:
    return operand.quantity.unit is None or is_plain(operand.quantity)


def _age_comparison(operator: Operator, node: ast.Binary, context: Context) -> Type:
    if operator in EQUALITY:
        reason = f"`{operator.value}` would hold for no time at all"
        report_misused_age(node, reason, context)
    elif is_age(node.left) and is_age(node.right):
        report_misused_age(node, "two ages are compared", context)
    else:
        bound = node.right if is_age(node.left) else node.left
        duration_ns(bound, "the age to compare with", context)
    return Boolean()


def _is_zero(divisor: ast.Expression, context: Context) -> bool:
    """Say whether a divisor is always zero. Report an error if it is."""
    value = context.values.get(divisor)
    is_zero = value is not None and value.numbers == (0.0,)
    if is_zero:
        context.collector.add(DivisionByZero().at(divisor.span))
    return is_zero
