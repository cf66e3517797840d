"""Expressions over the elements of an array. They may use one array, constants, and numbers of
other messages.

Other booleans and durations are not allowed inside them.
"""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Fix, Remark
from rossmarie.check.operations.beside import CONDITIONAL, QUANTIFIERS, unfit_part
from rossmarie.check.operations.errors import ArrayAsScalar
from rossmarie.check.operations.function_errors import ElementwiseMixture
from rossmarie.check.operations.rewriting import rewritten
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import quoted, stripped, text_of
from rossmarie.syntax import ast
from rossmarie.syntax.walk import children
from rossmarie.types import Array, Boolean, Unknown

Temporal = ast.Held | ast.Since | ast.Once | ast.Response
"""The operators over time."""


def check_elements(fold: ast.Call, context: Context) -> bool:
    """Say whether all parts of the argument of a fold are allowed there. Other parts are
    reported.
    """
    (argument,) = fold.arguments
    is_fit = True
    first: ast.Expression | None = None
    for part in parts_of(argument, context):
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
        is_fit = False
    return is_fit


def _reason(part: ast.Expression, context: Context) -> str | None:
    """The reason why a part is not allowed beside elements; None if it is allowed."""
    if isinstance(context.type_of(part), Boolean):
        return "this is the same for all elements"
    unfit = unfit_part(part, context)
    return None if unfit is None else unfit[1]


def _take_out(
    boolean: ast.Expression, fold: ast.Call, context: Context
) -> tuple[Remark, Fix | None]:
    """`any(ranges < 1 m) or ok` for `any(ranges < 1 m or ok)`."""
    function = fold.function.text
    junction = stripped(fold.arguments[0])
    text = text_of(boolean)
    help = ElementwiseMixture.OneProposition(text=text, function=function)
    if not isinstance(junction, ast.Binary) or junction.operator not in ast.JUNCTIONS:
        return help, None
    if function not in QUANTIFIERS or not (boolean is junction.left or boolean is junction.right):
        return help, None
    sides = (
        side.span.text if side is boolean else f"{function}({side.span.text})"
        for side in (junction.left, junction.right)
    )
    meant = f" {junction.operator.value} ".join(sides)
    taken_out = ElementwiseMixture.TakenOut(text=text, function=function, meant=quoted(meant))
    return taken_out, rewritten(fold, meant, context)


def enclosing_fold(node: ast.Expression, context: Context) -> ast.Call | None:
    """The `any`, `all` or `count` around a node, if there is one."""
    around = context.parents.get(node)
    while around is not None and not isinstance(around, ast.Edges):
        if isinstance(around, ast.Call) and around.function.text in CONDITIONAL:
            return around
        around = context.parents.get(around)
    return None


def report_elements_over_time(
    node: Temporal, operand: ast.Expression, fold: ast.Call, context: Context
) -> None:
    """Report an operator over time that is applied to the elements of an array, inside `fold`."""
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


def parts_of(argument: ast.Expression, context: Context) -> Iterator[ast.Expression]:
    """The arrays in an argument of a fold, and the changing single values, in source order."""
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
