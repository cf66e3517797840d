"""Calls of the built-in functions, and `oscillates`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from dslkit.diagnostics import Remark, Write, listed
from rossmarie.check.names.frames import check_one_frame
from rossmarie.check.names.regions import check_frame_of_region
from rossmarie.check.operations.amounts import AMOUNTS, type_of_amount
from rossmarie.check.operations.angles import warn_of_filter, warn_of_rate
from rossmarie.check.operations.changes import type_of_changed
from rossmarie.check.operations.edges import report_edges_elsewhere
from rossmarie.check.operations.elements import check_elements
from rossmarie.check.operations.errors import DurationOutOfRange, NotAnArray
from rossmarie.check.operations.function_errors import (
    OscillationCount,
    UnknownFunction,
    WrongArgument,
    WrongArgumentCount,
)
from rossmarie.check.operations.operands import (
    duration_ns,
    is_edge_count,
    report_array,
    report_not_a_number,
    report_uncompared,
    require_constant,
    scalar_operand,
)
from rossmarie.check.operations.operators import applied
from rossmarie.check.operations.raw_readings import warn_of_raw_readings
from rossmarie.check.operations.stopping import wanted_speed
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import stripped, text_of
from rossmarie.check.units.quantities import check_fit
from rossmarie.check.wording.describe import describe
from rossmarie.check.wording.suggestions import near_name, suggesting
from rossmarie.syntax import ast
from rossmarie.types import (
    SIGNATURES,
    Array,
    Boolean,
    Fault,
    List,
    Message,
    Motion,
    Operator,
    Quantity,
    Quaternion,
    Region,
    Type,
    Unknown,
    Vector,
    apply,
)
from rossmarie.units import DIMENSIONLESS

MOST_TURNING_POINTS = 64

USAGES: Mapping[Operator, str] = {
    Operator.ABS: "abs(x)",
    Operator.NORM: "norm(vector)",
    Operator.HYPOT: "hypot(a, b)",
    Operator.MIN: "min(a, b)` or `min(array)",
    Operator.MAX: "max(a, b)` or `max(array)",
    Operator.ANY: "any(array > 1)",
    Operator.ALL: "all(array > 1)",
    Operator.COUNT: "count(array > 1)",
    Operator.SIN: "sin(angle)",
    Operator.COS: "cos(angle)",
    Operator.ROLL: "orientation.roll()",
    Operator.PITCH: "orientation.pitch()",
    Operator.YAW: "orientation.yaw()",
    Operator.DISTANCE: "distance(a, b)",
    Operator.STOPPING: "stopping(motion, 0.3 m/s)",
    **AMOUNTS,
    Operator.RATE: "rate(x)",
    Operator.PREVIOUS: "previous(x)",
    Operator.MEDIAN: "median(x, 0.2 sec)",
    Operator.MEAN: "mean(x, 0.2 sec)",
    Operator.LOW_PASS: "low_pass(x, 0.2 sec)",
    Operator.CHANGED: "changed(x)",
    Operator.AGE: "age(input) > 0.5 sec",
}
"""The notation of each function. Its keys are all built-in functions."""

_FUNCTIONS: Mapping[str, Operator] = {operator.value: operator for operator in USAGES}
_NEEDS: Mapping[Operator, str] = {
    Operator.NORM: "a vector",
    Operator.SIN: "an angle",
    Operator.COS: "an angle",
    Operator.ROLL: "an orientation",
    Operator.PITCH: "an orientation",
    Operator.YAW: "an orientation",
    Operator.DISTANCE: "two vectors, or a position and a class of individuals",
    Operator.STOPPING: "a motion",
}
_FIELDS: Mapping[Operator, type[object]] = {
    Operator.NORM: Vector,
    Operator.ROLL: Quaternion,
    Operator.PITCH: Quaternion,
    Operator.YAW: Quaternion,
}
_TIMES: Mapping[Operator, str] = {
    Operator.MEDIAN: "the window of `median`",
    Operator.MEAN: "the window of `mean`",
    Operator.LOW_PASS: "the time constant of `low_pass`",
}
"""The functions with a constant time, and the meaning of this time."""
_MOST_FIELDS = 4
_OF_ONE_FRAME = frozenset({Operator.DISTANCE, Operator.HYPOT, Operator.MIN, Operator.MAX})
_QUANTIFIERS = frozenset({Operator.ANY, Operator.ALL, Operator.COUNT})
_EXTREMES = frozenset({Operator.MIN, Operator.MAX})


def type_of_call(node: ast.Call, context: Context) -> Type:
    """The type of a call whose arguments have types."""
    operator = _FUNCTIONS.get(node.function.text)
    if operator is None:
        _report_unknown(node.function, context)
        return Unknown()
    if not _check_count(node, operator, context):
        return Unknown()
    name = node.function.text
    if [each for each in node.arguments if report_edges_elsewhere(each, name, context)]:
        return Unknown()
    if is_edge_count(node):
        return Quantity(DIMENSIONLESS)
    if operator is Operator.CHANGED:
        return type_of_changed(node, context)
    if operator is Operator.AGE:
        return _age(node, context)
    if operator in _QUANTIFIERS or (operator in _EXTREMES and len(node.arguments) == 1):
        return _fold(node, operator, context)
    if operator in _TIMES:
        warn_of_filter(node, context)
        return _filter(node, operator, context)
    if operator in AMOUNTS:
        return type_of_amount(node, operator, context)
    if operator is Operator.RATE:
        warn_of_rate(node, context)
    return _function(node, operator, context)


def _report_unknown(name: ast.Name, context: Context) -> None:
    known = [*_FUNCTIONS, Operator.OSCILLATES.value]
    begun = (function for function in known if name.text.startswith(function))
    near = near_name(name.text, known) or next(begun, None)
    finding = UnknownFunction(identifier=name.text)
    if near is None:
        context.collector.add(finding.at(name.span, help=finding.Known(known=listed(known))))
        return
    context.collector.add(suggesting(finding, name, near))


def _check_count(node: ast.Call, operator: Operator, context: Context) -> bool:
    signature = SIGNATURES[operator]
    count = len(node.arguments)
    if count >= signature.least and (signature.most is None or count <= signature.most):
        return True
    # The operand before the dot is not counted, because the user sees no argument there.
    before_dot = 1 if node.is_method else 0
    least, given = signature.least - before_dot, count - before_dot
    expected = {0: "no argument here", 1: "one argument"}.get(least, f"{least} arguments")
    if signature.most is None:
        expected = "at least one argument"
    elif signature.most > signature.least:
        expected = f"{least} or {signature.most - before_dot} arguments"
    finding = WrongArgumentCount(
        function=operator.value,
        expected=expected,
        found="none" if given == 0 else str(given),
        usage=USAGES[operator],
    )
    context.collector.add(finding.at(node.span))
    return False


def _age(node: ast.Call, context: Context) -> Type:
    """The type of an age. The expression around the age checks that it is compared with a time."""
    outcome = apply(Operator.AGE, context.type_of(node.arguments[0]))
    argument = stripped(node.arguments[0])
    if isinstance(argument, ast.Reference) and argument.name.text in context.inputs:
        return outcome.type
    if not isinstance(outcome.type, Unknown):
        _report_argument(node, node.arguments[0], "an input", context)
    return Unknown()


def _fold(node: ast.Call, operator: Operator, context: Context) -> Type:
    (argument,) = node.arguments
    if report_uncompared(argument, "it is not one side of a comparison", context):
        return Unknown()
    type_ = context.type_of(argument)
    outcome = apply(operator, type_)
    if not outcome.faults:
        if check_elements(node, context):
            warn_of_raw_readings(node, context)
    elif operator in _QUANTIFIERS and isinstance(type_, Array):
        _report_argument(node, argument, "a condition on the elements", context)
    elif operator in _EXTREMES and isinstance(type_, Array):
        _report_argument(node, argument, "numbers", context)
    elif isinstance(type_, Message):
        report_not_a_number(argument, context)
    else:
        _report_no_array(argument, type_, operator, context)
    return _result_of_fold(node, operator, outcome.type, context)


def _result_of_fold(node: ast.Call, operator: Operator, type_: Type, context: Context) -> Type:
    """The type of the result, whatever error the argument has: one finding for `any(x) < 1` is
    enough.
    """
    around = context.parents.get(node)
    is_compared = isinstance(around, ast.Binary) and around.operator not in ast.JUNCTIONS
    if isinstance(type_, Unknown) and is_compared:
        return type_
    if not isinstance(type_, Unknown):
        return type_
    if operator is Operator.COUNT:
        return Quantity(DIMENSIONLESS)
    return Boolean() if operator in _QUANTIFIERS else Unknown()


def _report_no_array(
    argument: ast.Expression, type_: Type, operator: Operator, context: Context
) -> None:
    finding = NotAnArray(purpose=f"`{operator.value}`", found=describe(type_))
    help: Remark = Write(meant=USAGES[operator])
    if isinstance(type_, List):
        help = finding.AllElements(function=operator.value, text=text_of(argument))
    context.collector.add(finding.at(argument.span, help=help))


def _filter(node: ast.Call, operator: Operator, context: Context) -> Type:
    value = scalar_operand(node.arguments[0], context)
    duration_ns(node.arguments[1], _TIMES[operator], context)
    return Unknown() if value is None else value.quantity


def _function(node: ast.Call, operator: Operator, context: Context) -> Type:
    types = [context.type_of(argument) for argument in node.arguments]
    if operator in _NEEDS:
        outcome = apply(operator, *types)
        if Fault.OPERANDS in outcome.faults:
            # If a class is named, the error is in the position.
            is_of_region = any(isinstance(type_, Region) for type_ in types)
            asked = list(zip(node.arguments, types, strict=True))[: 1 if is_of_region else None]
            for argument, type_ in asked:
                if apply(operator, *[type_ for _ in types]).faults:
                    _report_argument(node, argument, _NEEDS[operator], context)
            return outcome.type
        if operator is Operator.STOPPING:
            return _stopping(node, outcome.type, context)
        if operator is Operator.DISTANCE and isinstance(types[1], Region):
            is_known = check_frame_of_region(node.arguments[0], node.arguments[1], context)
            return outcome.type if is_known else Unknown()
    elif operator is not Operator.ABS:
        arrays = [
            argument
            for argument, type_ in zip(node.arguments, types, strict=True)
            if isinstance(type_, Array)
        ]
        for argument in arrays:
            report_array(argument, context)
        if arrays:
            return Unknown()
    is_mixed = operator in _OF_ONE_FRAME and not check_one_frame(node.arguments, context)
    return Unknown() if is_mixed else applied(operator, node.arguments, context)


def _stopping(node: ast.Call, type_: Type, context: Context) -> Type:
    """The type of the distance in which a motion stops. If the type is `Unknown`, the motion is
    already reported.
    """
    motion = context.type_of(node.arguments[0])
    if not isinstance(motion, Motion) or len(node.arguments) == 1:
        return type_
    speed = wanted_speed(node.arguments[1], context.motions[motion.name], context)
    return Unknown() if speed is None else type_


def _report_argument(
    node: ast.Call, argument: ast.Expression, expected: str, context: Context
) -> None:
    finding = WrongArgument(
        function=node.function.text,
        expected=expected,
        found=describe(context.type_of(argument)),
        usage=USAGES[_FUNCTIONS[node.function.text]],
    )
    help = _fields_for(node, argument, context)
    context.collector.add(finding.at(argument.span, help=help))


def _fields_for(node: ast.Call, argument: ast.Expression, context: Context) -> Remark | None:
    """The fields of a message to which a function can be applied; None if there are none."""
    wanted = _FIELDS.get(_FUNCTIONS[node.function.text])
    type_ = context.type_of(argument)
    if wanted is None or not isinstance(type_, Message):
        return None
    function, text = node.function.text, text_of(argument)
    fields = [f"{text}.{path}" for path in _paths_to(wanted, type_)]
    calls = [
        f"`{x}.{function}()`" if wanted is Quaternion else f"`{function}({x})`" for x in fields
    ]
    if not 0 < len(calls) <= _MOST_FIELDS:
        return None
    return WrongArgument.OfFields(calls=" or ".join(calls))


def _paths_to(wanted: type[object], message: Message) -> Iterator[str]:
    for name, field in message.fields.items():
        if isinstance(field, wanted):
            yield name
        elif isinstance(field, Message):
            yield from (f"{name}.{path}" for path in _paths_to(wanted, field))


def type_of_oscillates(node: ast.Oscillates, context: Context) -> Type:
    """The type of `oscillates(x, 3 times, within 0.25 sec, by 5 N)`: one boolean."""
    if report_edges_elsewhere(node.value, Operator.OSCILLATES.value, context):
        return Boolean()
    value = scalar_operand(node.value, context)
    _check_turning_points(node.count, context)
    duration_ns(node.window, "the time after `within`", context)
    swing = None if node.swing is None else scalar_operand(node.swing, context)
    if swing is None:
        return Boolean()
    is_constant = require_constant(swing.node, "a swing", context)
    if (value is None or check_fit(swing, value, "compared", context)) and is_constant:
        _check_swing(swing.node, swing.quantity, context)
    return Boolean()


def _check_turning_points(count: ast.Number, context: Context) -> None:
    is_count = count.value.is_integer() and 1 <= count.value <= MOST_TURNING_POINTS
    if count.unit is not None or not is_count:
        finding = OscillationCount(found=f"{count.value:.15g}", most=MOST_TURNING_POINTS)
        context.collector.add(finding.at(count.span))


def _check_swing(node: ast.Expression, quantity: Quantity, context: Context) -> None:
    number = context.values[node].numbers[0]
    unit = quantity.unit or DIMENSIONLESS
    if unit.offset:
        wrong = WrongArgument(
            function="oscillates",
            expected="a swing, as a temperature difference",
            found=f"a temperature in {unit.symbol}",
            usage="by 5 K",
        )
        context.collector.add(wrong.at(node.span))
    elif number <= 0:
        finding = DurationOutOfRange(
            purpose="a swing",
            bound="more than zero",
            found=f"{unit.from_si(number):.15g}",
            reason="it is the size of the smallest swing that counts",
        )
        context.collector.add(finding.at(node.span, help=finding.EveryTurn()))
