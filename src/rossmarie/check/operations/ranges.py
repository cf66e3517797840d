"""Intervals and boxes, and `in`."""

from __future__ import annotations

from dslkit.diagnostics import Edit, Fix, Label, Remark, Write
from rossmarie.check.model import Value
from rossmarie.check.names.regions import check_frame_of_region
from rossmarie.check.operations.constants import record
from rossmarie.check.operations.operands import (
    report_not_a_number,
    report_uncompared,
    require_constant,
    scalar_operand,
)
from rossmarie.check.operations.range_errors import (
    BracketLength,
    IntervalEndsSwapped,
    RangeMismatch,
    ScalarAsRange,
    StringsAsRange,
)
from rossmarie.check.operations.raw_readings import warn_of_raw_reading
from rossmarie.check.operations.rewriting import rewritten
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import constant_of, quoted, stripped, text_of
from rossmarie.check.units.errors import MisplacedUnit
from rossmarie.check.units.quantities import CheckedOperand, check_fit, check_fit_of, read_unit
from rossmarie.check.units.ratios import check_ratio
from rossmarie.check.wording.describe import describe, is_plain
from rossmarie.syntax import ast
from rossmarie.types import (
    Boolean,
    Box,
    Fault,
    Interval,
    Operator,
    Quantity,
    Region,
    Text,
    Type,
    Unknown,
    apply,
)
from rossmarie.units import Unit

_INTERVAL_LENGTH = 2
_BOX_LENGTH = 6


def type_of_bracket(node: ast.Bracket, context: Context) -> Type:
    """The interval or box that a bracket stands for; its value is recorded."""
    unit = None if node.unit is None else read_unit(node.unit, context.collector)
    if all(isinstance(context.type_of(element), Text) for element in node.elements):
        _report_texts(node, context)
        return Unknown()
    if len(node.elements) not in (_INTERVAL_LENGTH, _BOX_LENGTH):
        context.collector.add(BracketLength(count=len(node.elements)).at(node.span))
        return Unknown()
    operands = [scalar_operand(element, context) for element in node.elements]
    ends = [operand for operand in operands if operand is not None]
    all_constant = [require_constant(end.node, "an end of a range", context) for end in ends]
    if (node.unit is not None and unit is None) or len(ends) < len(operands):
        return Unknown()
    if not all(all_constant) or not _check_ends(node, ends, unit, context):
        return Unknown()
    numbers = [context.values[end.node].numbers[0] for end in ends]
    if unit is not None:
        numbers = [unit.to_si(number) for number in numbers]
    return _range_of(node, Quantity(unit or ends[0].quantity.unit), numbers, context)


def _report_texts(node: ast.Bracket, context: Context) -> None:
    around = context.parents.get(node)
    help, fix = None, None
    if isinstance(around, ast.Membership) and isinstance(context.type_of(around.value), Text):
        sign, junction = ("!=", " and ") if around.is_negated else ("==", " or ")
        value = around.value.span.text
        meant = junction.join(f"{value} {sign} {text.span.text}" for text in node.elements)
        help, fix = Write(meant=quoted(meant)), rewritten(around, meant, context)
    context.collector.add(StringsAsRange().at(node.span, help=help, fix=fix))


def _check_ends(
    node: ast.Bracket, ends: list[CheckedOperand], unit: Unit | None, context: Context
) -> bool:
    if unit is None:
        fits = [check_fit(ends[0], end, "the ends of one range", context) for end in ends[1:]]
        return all(fits)
    second_units = [end for end in ends if not is_plain(end.quantity)]
    for end in second_units:
        finding = MisplacedUnit(
            reason="both this end and the whole range have a unit",
        )
        place = () if node.unit is None else (finding.OfBothEnds().at(node.unit.span),)
        help = finding.OnceInRange(unit=unit.symbol)
        context.collector.add(finding.at(end.node.span, *place, help=help))
    return not second_units


def _range_of(node: ast.Bracket, element: Quantity, numbers: list[float], context: Context) -> Type:
    if len(numbers) == _BOX_LENGTH:
        pairs = [sorted(numbers[axis : axis + 2]) for axis in range(0, _BOX_LENGTH, 2)]
        box = Box(element)
        ordered = tuple(end for pair in pairs for end in pair)
        return box if record(node, Value(box, ordered), context) else Unknown()
    low, high = numbers
    if low > high:
        _report_swapped(node, context)
        return Unknown()
    interval = Interval(element)
    return interval if record(node, Value(interval, (low, high)), context) else Unknown()


def _report_swapped(node: ast.Bracket, context: Context) -> None:
    low, high = node.elements
    unit = "" if node.unit is None else f" {node.unit.text}"
    corrected = f"[{text_of(high)}, {text_of(low)}]{unit}"
    finding = IntervalEndsSwapped(low=text_of(low), high=text_of(high), corrected=corrected)
    edits = (Edit(low.span, high.span.text), Edit(high.span, low.span.text))
    context.collector.add(finding.at(node.span, fix=Fix("swap the ends", edits)))


def type_of_membership(node: ast.Membership, context: Context) -> Type:
    """The type of `x in range`: one boolean, or one boolean for each element of an array."""
    value, container = context.type_of(node.value), context.type_of(node.container)
    sides = (node.value, node.container)
    if any(report_uncompared(side, "`in` has two ends", context, node) for side in sides):
        return Boolean()
    outcome = apply(Operator.IN, value, container)
    if Fault.NOT_A_RANGE in outcome.faults:
        _report_scalar(node, container, context)
    if Fault.VECTOR in outcome.faults:
        report_not_a_number(node.value, context)
    if Fault.OPERANDS in outcome.faults:
        _report_unfit(node, value, container, context)
    if Fault.UNITS in outcome.faults or Fault.UNSTATED_UNIT in outcome.faults:
        check_fit_of(node.value, node.container, "compared", context)
    if not outcome.faults and isinstance(container, Region):
        check_frame_of_region(node.value, node.container, context)
    elif not outcome.faults:
        check_ratio(node.value, node.container, context)
        warn_of_raw_reading(node, context)
    return outcome.type


def _report_unfit(node: ast.Membership, value: Type, container: Type, context: Context) -> None:
    if isinstance(container, Interval):
        report_not_a_number(node.value, context)
        return
    finding = RangeMismatch(value=describe(value), container=describe(container))
    place = finding.Value(value=describe(value)).at(node.value.span)
    help = _help_with(node, container, finding)
    context.collector.add(finding.at(node.container.span, place, help=help))


def _help_with(node: ast.Membership, container: Type, finding: RangeMismatch) -> Remark:
    if isinstance(container, Region) and not container.has_area:
        sides = (text_of(node.value), text_of(node.container))
        return finding.OfPoints(value=sides[0], container=sides[1])
    return finding.Position() if isinstance(container, Box | Region) else finding.Range()


def _report_scalar(node: ast.Membership, scalar: Type, context: Context) -> None:
    finding = ScalarAsRange(found=describe(scalar))
    if node.container not in context.values:
        context.collector.add(finding.at(node.container.span, help=finding.NotConstant()))
        return
    constant = constant_of(stripped(node.container), context.declarations)
    written = node.container if constant is None else constant.value
    meant = _interval_around_zero(written)
    is_shared = constant is not None and constant.name.text in context.names_used_as_numbers
    place = node.container if is_shared else written
    fix = Fix(f"write the interval `{meant}`", (Edit(place.span, meant),))
    help = finding.AroundZero(end=text_of(written), meant=meant)
    labels: tuple[Label, ...] = ()
    if constant is not None:
        labels = (finding.Constant(constant=constant.name.text).at(constant.value.span),)
    context.collector.add(finding.at(node.container.span, *labels, help=help, fix=fix))


def _interval_around_zero(written: ast.Expression) -> str:
    number = stripped(written)
    if isinstance(number, ast.Number):
        unit = "" if number.unit is None else f" {number.unit.text}"
        end = f"{abs(number.value):.15g}"
        return f"[-{end}, {end}]{unit}"
    text = text_of(written)
    return f"[-({text}), {text}]"
