"""Expressions over the elements of an array: they may use one array, constants, and numbers of
other messages.

A truth of its own, or a time that something has to hold, belongs outside.
"""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Edit, Fix, Remark
from dslkit.source import Span
from rossmarie.check.operations.beside import CONDITIONAL, QUANTIFIERS, unfit_part
from rossmarie.check.operations.errors import ArrayAsScalar
from rossmarie.check.operations.function_errors import ElementwiseMixture
from rossmarie.check.operations.rewriting import rewritten
from rossmarie.check.operations.sector_errors import RawReadings
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import quoted, stripped, text_of
from rossmarie.syntax import ast
from rossmarie.syntax.walk import children
from rossmarie.types import Array, Boolean, Unknown

Temporal = ast.Held | ast.Since | ast.Once | ast.Response
"""The operators over time."""

_ALL_AROUND = "[-180 deg .. 180 deg]"


def check_elements(fold: ast.Call, context: Context) -> None:
    """Report parts of the argument of a fold that may not stand in it."""
    (argument,) = fold.arguments
    first: ast.Expression | None = None
    for part in _parts(argument, context):
        is_array = isinstance(context.type_of(part), Array)
        if is_array and first is None:
            first = part
            continue
        if is_array and first is not None and _spelling(part) == _spelling(first):
            continue
        found = "this is another array" if is_array else _reason(part, context)
        if found is None:
            continue
        finding = ElementwiseMixture(found=found, function=fold.function.text, text=text_of(part))
        labels = () if first is None else (finding.Array().at(first.span),)
        help, fix = None, None
        if isinstance(context.type_of(part), Boolean):
            help, fix = _take_out(part, fold, context)
        context.collector.add(finding.at(part.span, *labels, help=help, fix=fix))


def _reason(part: ast.Expression, context: Context) -> str | None:
    """The reason why something beside elements may not stand there; None if it may."""
    if isinstance(context.type_of(part), Boolean):
        return "this is the same for all elements"
    unfit = unfit_part(part, context)
    return None if unfit is None else unfit[1]


def warn_of_raw_readings(fold: ast.Call, context: Context) -> None:
    """Warn of a fold over all readings of a scan, in which one that is no distance decides."""
    (argument,) = fold.arguments
    parts = [part for part in _parts(argument, context) if _is_raw(part, context)]
    if not parts or fold.function.text == "max" or _is_bounded_below(argument, context):
        return
    if fold.function.text in ("any", "count") and _asks_what_is_far(argument):
        return
    text = parts[0].span.text
    edits = (Edit(_behind(part.span), _ALL_AROUND) for part in parts)
    fix = Fix(f"write `{quoted(f'{text}{_ALL_AROUND}')}`", tuple(edits))
    context.collector.add(RawReadings(text=quoted(text)).at(parts[0].span, fix=fix))


def _is_raw(part: ast.Expression, context: Context) -> bool:
    """Say whether these are all readings, although the input reads the whole scan, and so brings
    what tells which of them are distances.
    """
    if not isinstance(part, ast.Member):
        return False
    type_ = context.type_of(part)
    return isinstance(type_, Array) and type_.has_sectors


def _is_bounded_below(argument: ast.Expression, context: Context) -> bool:
    """Say whether a condition asks for a range that begins above 0."""
    node = stripped(argument)
    if not isinstance(node, ast.Membership) or node.is_negated:
        return False
    value = context.values.get(node.container)
    return value is not None and bool(value.numbers) and value.numbers[0] > 0.0


def _asks_what_is_far(argument: ast.Expression) -> bool:
    """Say whether a condition is that of elements above something, which a reading of 0 is not."""
    node = stripped(argument)
    above = (ast.BinaryOperator.GREATER, ast.BinaryOperator.GREATER_OR_EQUAL)
    return isinstance(node, ast.Binary) and node.operator in above


def _behind(span: Span) -> Span:
    return Span(span.file, span.end, span.end)


def _take_out(truth: ast.Expression, fold: ast.Call, context: Context) -> tuple[Remark, Fix | None]:
    """`any(ranges < 1 m) or ok` for `any(ranges < 1 m or ok)`."""
    function = fold.function.text
    junction = stripped(fold.arguments[0])
    text = text_of(truth)
    help = ElementwiseMixture.OneTruth(text=text, function=function)
    if not isinstance(junction, ast.Binary) or junction.operator not in ast.JUNCTIONS:
        return help, None
    if function not in QUANTIFIERS or not (truth is junction.left or truth is junction.right):
        return help, None
    sides = (
        side.span.text if side is truth else f"{function}({side.span.text})"
        for side in (junction.left, junction.right)
    )
    meant = f" {junction.operator.value} ".join(sides)
    taken_out = ElementwiseMixture.TakenOut(text=text, function=function, meant=quoted(meant))
    return taken_out, rewritten(fold, meant, context)


def enclosing_fold(node: ast.Expression, context: Context) -> ast.Call | None:
    """The `any`, `all` or `count` that a node stands in, if it stands in one."""
    around = context.parents.get(node)
    while around is not None and not isinstance(around, ast.Edges):
        if isinstance(around, ast.Call) and around.function.text in CONDITIONAL:
            return around
        around = context.parents.get(around)
    return None


def report_elements_over_time(
    node: Temporal, operand: ast.Expression, fold: ast.Call, context: Context
) -> None:
    """Report that an operator over time stands on the elements of an array, inside `fold`."""
    function = fold.function.text
    finding = ArrayAsScalar(expected="condition")
    is_whole = stripped(fold.arguments[0]) is node and function in QUANTIFIERS
    help: Remark
    fix = None
    match node:
        case ast.Held() if is_whole:
            meant = f"{function}({operand.span.text}) for {node.duration.span.text}"
            help = finding.WatchedTogether(meant=quoted(meant))
            fix = rewritten(fold, meant, context)
        case ast.Held():
            help = finding.NotWatched()
        case ast.Since() | ast.Once() | ast.Response():
            help = finding.WatchedOutside(function=function)
    context.collector.add(finding.at(operand.span, help=help, fix=fix))


def _parts(argument: ast.Expression, context: Context) -> Iterator[ast.Expression]:
    """The arrays, and the changing single values, in the order in which they are written."""
    pending = [argument]
    while pending:
        node = pending.pop()
        type_ = context.type_of(node)
        if node in context.values or isinstance(type_, Unknown):
            continue
        is_chain = isinstance(node, ast.Reference | ast.Member | ast.Sector)
        if is_chain or not isinstance(type_, Array):
            yield node
        else:
            pending.extend(reversed(children(node)))


def _spelling(node: ast.Expression) -> str:
    return "".join(node.span.text.split())
