"""The operands of operators: numbers, booleans, constant times. Operands of a wrong type are
reported.
"""

from __future__ import annotations

from dslkit.diagnostics import Diagnostic, Edit, Fix, Write
from dslkit.source import Span
from rossmarie.check.names.fields import members
from rossmarie.check.operations.errors import (
    ArrayAsScalar,
    DurationOutOfRange,
    MessageAsValue,
    NotACondition,
    NotADuration,
    NotANumber,
    NotConstant,
    OrientationAsScalar,
    VectorAsScalar,
)
from rossmarie.check.operations.function_errors import AgeMisused, EdgesMisused
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import stripped, text_of
from rossmarie.check.units.quantities import SECOND, CheckedOperand
from rossmarie.check.wording.describe import describe
from rossmarie.syntax import ast
from rossmarie.syntax.walk import children
from rossmarie.types import (
    Array,
    Boolean,
    Entry,
    List,
    Message,
    Quantity,
    Quaternion,
    Text,
    Type,
    Unknown,
    Vector,
)

LONGEST_DURATION_S = 1e9
"""About 32 years. The sum of instants and durations has to fit into 64 bits of nanoseconds."""


def scalar_operand(node: ast.Expression, context: Context) -> CheckedOperand | None:
    """The one number that `node` stands for; None, after reporting, if it is not a single
    number.
    """
    type_ = context.type_of(node)
    if report_uncompared(node, "it is not one side of a comparison", context):
        return None
    if isinstance(type_, Quantity):
        return CheckedOperand(node, type_)
    if isinstance(type_, Array) and isinstance(type_.element, Quantity):
        report_array(node, context)
    else:
        report_not_a_number(node, context)
    return None


def report_array(node: ast.Expression, context: Context) -> None:
    """Report an array where one number is needed."""
    text = text_of(node)
    finding = ArrayAsScalar(expected="number")
    context.collector.add(finding.at(node.span, help=finding.Number(text=text)))


def report_uncompared(
    node: ast.Expression, reason: str, context: Context, at: ast.Expression | None = None
) -> bool:
    """Report an age or a count of edges that is not compared with a constant. Returns True if
    `node` is an age or a count of edges.
    """
    place = node if at is None else at
    if is_age(node):
        report_misused_age(place, reason, context)
    elif is_edge_count(node):
        context.collector.add(EdgesMisused(reason=reason).at(place.span))
    return is_age(node) or is_edge_count(node)


def report_misused_age(node: ast.Expression, reason: str, context: Context) -> None:
    """Report an age that is not compared with a constant time."""
    context.collector.add(AgeMisused(reason=reason).at(node.span))


def is_age(node: ast.Expression) -> bool:
    """Say whether this is a call of `age`."""
    inner = stripped(node)
    return isinstance(inner, ast.Call) and inner.function.text == "age"


def is_edge_count(node: ast.Expression) -> bool:
    """Say whether this is `count(edges of ...)`."""
    inner = stripped(node)
    is_count = isinstance(inner, ast.Call) and inner.function.text == "count"
    return is_count and isinstance(inner, ast.Call) and _takes_edges(inner)


def _takes_edges(call: ast.Call) -> bool:
    return any(isinstance(argument, ast.Edges) for argument in call.arguments)


def report_not_a_number(node: ast.Expression, context: Context) -> None:
    """Report a value that is not a number where a number is needed."""
    type_ = context.type_of(node)
    if not isinstance(type_, Unknown):
        context.collector.add(_not_a_number(node, type_))


def _not_a_number(node: ast.Expression, type_: Type) -> Diagnostic:
    text = text_of(node)
    if isinstance(type_, Vector):
        return VectorAsScalar(found=describe(type_), text=text).at(node.span)
    if isinstance(type_, Quaternion):
        return OrientationAsScalar(text=text).at(node.span)
    if isinstance(type_, Message):
        return message_as_value(node, type_)
    finding = NotANumber(found=describe(type_))
    if isinstance(type_, Entry):
        return finding.at(node.span, help=finding.Fields(fields=_fields(text, type_)))
    if is_boolean(type_):
        return finding.at(node.span, help=finding.Boolean())
    if isinstance(type_, Text):
        return finding.at(node.span, help=finding.String())
    if isinstance(type_, List):
        return finding.at(node.span, help=finding.InList(text=text))
    return finding.at(node.span, help=finding.Range())


def _fields(text: str, entry: Entry) -> str:
    return ", ".join([f"`{text}.{name}`" for name in members(entry)][:8])


def message_as_value(node: ast.Expression, message: Message) -> Diagnostic:
    """The finding that a message is not a value. It suggests the fields of the message."""
    text = text_of(node)
    names = [f"`{text}.{name}`" for name in message.fields][:8]
    finding = MessageAsValue(found=message.name)
    if not names:
        return finding.at(node.span, help=finding.NoFields())
    return finding.at(node.span, help=finding.Fields(fields=", ".join(names)))


def is_boolean(type_: Type) -> bool:
    """Say whether a type is a boolean, or an array of booleans."""
    element = type_.element if isinstance(type_, Array) else type_
    return isinstance(element, Boolean)


def report_not_a_condition(node: ast.Expression, context: Context) -> None:
    """Report a value that is not a condition where a condition is needed."""
    type_ = context.type_of(node)
    if is_edge_count(node):
        report_uncompared(node, "it is a number, not a condition", context)
    elif not isinstance(type_, Unknown) and not is_boolean(type_):
        context.collector.add(_not_a_condition(node, type_))


def _not_a_condition(node: ast.Expression, type_: Type) -> Diagnostic:
    text = text_of(node)
    if isinstance(type_, Message):
        return message_as_value(node, type_)
    finding = NotACondition(found=describe(type_), text=text)
    if isinstance(type_, Entry):
        return finding.at(node.span, help=finding.Fields(fields=_fields(text, type_)))
    if isinstance(type_, Text):
        return finding.at(node.span, help=finding.String(text=text))
    if isinstance(type_, List):
        return finding.at(node.span, help=finding.InList(text=text))
    if isinstance(type_, Quaternion):
        return finding.at(node.span, help=finding.Angle(text=text))
    if isinstance(type_, Vector):
        return finding.at(node.span, help=finding.Length(text=text))
    if isinstance(type_, Array):
        return finding.at(node.span, help=finding.Elements(text=text))
    return finding.at(node.span)


def require_condition(node: ast.Expression, context: Context) -> None:
    """Report `node` if it is not a single boolean."""
    type_ = context.type_of(node)
    if not (isinstance(type_, Array) and is_boolean(type_)):
        report_not_a_condition(node, context)
        return
    text = text_of(node)
    finding = ArrayAsScalar(expected="condition")
    help = finding.Condition(text=text)
    before, behind = (Span(node.span.file, at, at) for at in (node.span.start, node.span.end))
    fix = Fix(f"write `any({text})`", (Edit(before, "any("), Edit(behind, ")")))
    context.collector.add(finding.at(node.span, help=help, fix=fix))


def duration_ns(node: ast.Expression, purpose: str, context: Context) -> int | None:
    """A constant time in ns; None, after reporting, if `node` is not a constant time."""
    type_ = context.type_of(node)
    if isinstance(type_, Unknown):
        return None
    is_time = (
        isinstance(type_, Quantity)
        and type_.unit is not None
        and type_.unit.dimension == SECOND.dimension
    )
    if not is_time:
        _report_not_a_duration(node, type_, purpose, context)
        return None
    if not require_constant(node, purpose, context):
        return None
    seconds = context.values[node].numbers[0]
    # The check comes before the multiplication, which overflows for a huge number of seconds.
    if 0 < seconds <= LONGEST_DURATION_S and round(seconds * 1e9) > 0:
        return round(seconds * 1e9)
    context.collector.add(_out_of_range(node, seconds, purpose))
    return None


def _report_not_a_duration(
    node: ast.Expression, type_: Type, purpose: str, context: Context
) -> None:
    finding = NotADuration(purpose=purpose, found=describe(type_))
    inner = stripped(node)
    if isinstance(inner, ast.Number) and inner.unit is None:
        corrected = f"{text_of(inner)} sec"
        behind = Span(inner.span.file, inner.span.end, inner.span.end)
        fix = Fix(f"write `{corrected}`", (Edit(behind, " sec"),))
        context.collector.add(finding.at(node.span, help=Write(meant=corrected), fix=fix))
    else:
        context.collector.add(finding.at(node.span))


def _out_of_range(node: ast.Expression, seconds: float, purpose: str) -> Diagnostic:
    if seconds > LONGEST_DURATION_S:
        bound, reason = "at most 1e9 sec", "instants are counted in nanoseconds, in 64 bits"
    else:
        bound, reason = "more than zero", "the clock of a monitor counts whole nanoseconds"
    finding = DurationOutOfRange(
        purpose=purpose, bound=bound, found=f"{seconds:g} sec", reason=reason
    )
    return finding.at(node.span)


def require_constant(node: ast.Expression, purpose: str, context: Context) -> bool:
    """Say whether the value of `node` is known. If it is not, report the part that is not
    constant.
    """
    if node in context.values:
        return True
    changing = node
    while True:
        parts = [part for part in children(changing) if part not in context.values]
        if isinstance(changing, ast.Member) or not parts:
            break
        changing = parts[0]
    if not isinstance(context.type_of(changing), Unknown):
        context.collector.add(NotConstant(purpose=purpose).at(changing.span))
    return False
