"""Queries about the elements of a list of messages: `any(o in objects: o.size.x > 1 m)`.

An ordinary expression follows the colon, in which the name stands for an element. It may use the
element, constants, and numbers of other messages.
"""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Edit, Fix, Remark
from rossmarie.check.model import Value
from rossmarie.check.names.fields import lists_in
from rossmarie.check.names.references import is_value
from rossmarie.check.operations.beside import (
    CONDITIONAL,
    EXTREMES,
    OF_SAMPLES,
    QUANTIFIERS,
    nature_of_call,
)
from rossmarie.check.operations.list_errors import NotOfTheElement, NotOverAList, UnboundedList
from rossmarie.check.operations.operands import require_condition, scalar_operand
from rossmarie.check.operations.rewriting import rewritten
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.declarations import ARTICLES, kind_of
from rossmarie.check.scopes.errors import DuplicateName
from rossmarie.check.scopes.trees import quoted, root_of, stripped, text_of
from rossmarie.check.units.quantities import end_of_field
from rossmarie.check.wording.describe import describe
from rossmarie.syntax import ast
from rossmarie.syntax.node_map import NodeMap
from rossmarie.syntax.walk import children, walk
from rossmarie.types import Array, Boolean, List, Message, Quantity, Type, Unknown
from rossmarie.units import DIMENSIONLESS

USUAL_BOUND = 64
USUAL_POINTS = 65_536
USUAL_BEAMS = 1_440
"""The bounds that are suggested if there is no bound: for lists of messages, clouds and scans."""

_MOST_LISTS = 4


def type_of_list_fold(node: ast.ListFold, context: Context) -> Type:
    """The type of a fold whose list and body have types."""
    function = node.function.text
    _check_variable(node, context)
    if function not in CONDITIONAL | EXTREMES:
        finding = NotOverAList(variable=node.variable.text, found=f"`{function}`")
        context.collector.add(finding.at(node.function.span))
        return Unknown()
    _check_list(node, context)
    if not _check_body(node, context):
        return Unknown()
    if function in CONDITIONAL:
        require_condition(node.body, context)
        return Quantity(DIMENSIONLESS) if function == "count" else Boolean()
    value = scalar_operand(node.body, context)
    return Unknown() if value is None else Quantity(value.quantity.unit)


def _check_variable(node: ast.ListFold, context: Context) -> None:
    """Report a name for the element that has another meaning."""
    name = node.variable.text
    own = context.declarations.conditions.get(context.entity or "", {})
    declared = context.declarations.names.get(name)
    other: ast.Name | None = None
    kind = ""
    if declared is not None:
        other, kind = declared.name, ARTICLES[kind_of(declared)]
    elif name in own:
        other, kind = own[name].name, "a condition"
    if other is None:
        return
    finding = DuplicateName(
        identifier=name,
        kind="element",
        other=kind,
        reason="inside the parentheses, the name could refer to either",
    )
    edits = [Edit(node.variable.span, f"each_{name}")]
    edits += [
        Edit(part.span, f"each_{name}")
        for part in walk(node.body)
        if isinstance(part, ast.Reference) and part.name.text == name
    ]
    fix = Fix(f"call the element `each_{name}`", tuple(edits))
    context.collector.add(finding.at(node.variable.span, finding.First().at(other.span), fix=fix))


# --- the list --------------------------------------------------------------------------------


def _check_list(node: ast.ListFold, context: Context) -> None:
    type_ = context.type_of(node.list)
    if isinstance(type_, Unknown):
        return
    if not isinstance(type_, List):
        _report_no_list(node, type_, context)
        return
    root = root_of(node.list)
    used = None if root is None else context.inputs.get(root.name.text)
    if used is None or used.declaration.bound is not None:
        return
    bound = USUAL_BEAMS if type_.is_of_beams else USUAL_BOUND
    bound = USUAL_POINTS if type_.is_of_points else bound
    finding = UnboundedList(text=text_of(node.list), bound=bound)
    fix = None
    if root is not None and root.name.text not in context.proposed_bounds:
        context.proposed_bounds.add(root.name.text)
        edit = Edit(end_of_field(used.declaration), f" up to {bound}")
        fix = Fix(f"insert `up to {bound}`", (edit,))
    place = finding.Declared().at(used.declaration.name.span)
    context.collector.add(finding.at(node.list.span, place, fix=fix))


def _report_no_list(node: ast.ListFold, type_: Type, context: Context) -> None:
    text = text_of(node.list)
    finding = NotOverAList(variable=node.variable.text, found=describe(type_))
    help: Remark | None = None
    if isinstance(type_, Array):
        help = finding.OfArray(function=node.function.text, text=text)
    elif isinstance(type_, Message) and (lists := lists_in(type_)):
        shown = (f"`{text}.{'.'.join(path)}`" for path in lists[:_MOST_LISTS])
        help = finding.ChooseList(lists=", ".join(shown))
    context.collector.add(finding.at(node.list.span, help=help))


# --- the body --------------------------------------------------------------------------------


def _check_body(node: ast.ListFold, context: Context) -> bool:
    """Report all parts that are not allowed beside the element. Returns False if the body is the
    same for all elements.
    """
    naming = _naming(node, context)
    others = list(_others(node, naming, context))
    for part, found, help in others:
        finding = _finding(node, found)
        fix = None
        if isinstance(part, ast.Held):
            help, fix = _held(node, part, context)
        context.collector.add(finding.at(part.span, help=help, fix=fix))
    is_open = node.body in naming or counts_all(node, context.types, context.values)
    if others or is_open or isinstance(context.type_of(node.body), Unknown):
        return True
    finding = _finding(node, "this is the same for all elements")
    help = finding.Unused(variable=node.variable.text)
    context.collector.add(finding.at(node.body.span, help=help))
    return False


def _naming(fold: ast.ListFold, context: Context) -> NodeMap[bool]:
    """The parts of the body that contain the name of the element."""
    found: NodeMap[bool] = NodeMap()
    for part in walk(fold.body):
        if not isinstance(part, ast.Reference) or part.name.text != fold.variable.text:
            continue
        around: ast.Expression | None = part
        while around is not None and around is not fold and around not in found:
            found[around] = True
            around = context.parents.get(around)
    return found


def counts_all(fold: ast.ListFold, types: NodeMap[Type], values: NodeMap[Value]) -> bool:
    """Say whether the call is `count(p in cloud: true)`, the number of points or beams."""
    its_list, value = types.get(fold.list), values.get(fold.body)
    can_count = isinstance(its_list, List) and (its_list.is_of_points or its_list.is_of_beams)
    return can_count and fold.function.text == "count" and bool(value and value.boolean)


def _finding(node: ast.ListFold, found: str) -> NotOfTheElement:
    return NotOfTheElement(
        function=node.function.text,
        variable=node.variable.text,
        text=text_of(node.list),
        found=found,
    )


_Other = tuple[str, Remark | None]
"""The description of a part that does not belong to the element, and a special help if there is
one.
"""


def _others(
    fold: ast.ListFold, naming: NodeMap[bool], context: Context
) -> Iterator[tuple[ast.Expression, str, Remark | None]]:
    """The outermost parts of the body that are not allowed in it."""
    pending = [fold.body]
    while pending:
        node = pending.pop()
        if node in context.values or node in context.regions:
            continue
        other = _other(node, fold, naming, context)
        if other is not None:
            yield (node, *other)
        elif node in naming:
            pending.extend(reversed(children(node)))
        else:
            yield from _same_for_all(node, fold, naming, context)


def _same_for_all(
    node: ast.Expression, fold: ast.ListFold, naming: NodeMap[bool], context: Context
) -> Iterator[tuple[ast.Expression, str, Remark | None]]:
    """The parts that are not allowed in a part that is the same for all elements. Numbers are
    allowed.
    """
    type_ = context.type_of(node)
    if isinstance(type_, Boolean) and node is not fold.body:
        yield node, "this is one boolean for all elements", None
    elif isinstance(type_, Array | List):
        yield node, "this is no part of the element", None
    elif not isinstance(type_, Boolean | Unknown):
        for part in walk(node):
            other = _other(part, fold, naming, context)
            if other is not None:
                yield (part, *other)
                return


def _other(
    node: ast.Expression, fold: ast.ListFold, naming: NodeMap[bool], context: Context
) -> _Other | None:
    match node:
        case ast.Member() if not is_value(node, context):
            return "this is one boolean for all elements", None
        case ast.Doing():
            return "this is one boolean for all elements", None
        case ast.Held() | ast.Once() | ast.Response():
            return "this looks at one element for a time", None
        case ast.Since() | ast.Edges() | ast.Oscillates():
            return "this follows one element over time", None
        case ast.ListFold():
            return "this looks at another list", NotOfTheElement.OneLevel()
        case ast.Call():
            return _other_call(node, fold, naming, context)
        case (
            ast.Number() | ast.Boolean() | ast.Text() | ast.Bracket() | ast.Reference()
            | ast.Member() | ast.Index() | ast.Sector() | ast.Unary() | ast.Binary()
            | ast.Membership() | ast.Parenthesized() | ast.Broken()
        ):  # fmt: skip
            return None


def _other_call(
    node: ast.Call, fold: ast.ListFold, naming: NodeMap[bool], context: Context
) -> _Other | None:
    name, nature = node.function.text, nature_of_call(node, context)
    if nature is None:
        return None
    variable, text = fold.variable.text, text_of(fold.list)
    if name in OF_SAMPLES and node in naming:
        return nature, NotOfTheElement.Samples(called=name, variable=variable, text=text)
    if name in OF_SAMPLES | EXTREMES:
        number = text_of(node)
        return nature, NotOfTheElement.Number(variable=variable, text=text, number=number)
    return nature, NotOfTheElement.OneLevel() if name in CONDITIONAL else None


def _held(fold: ast.ListFold, held: ast.Held, context: Context) -> tuple[Remark, Fix | None]:
    if stripped(fold.body) is not held or fold.function.text not in QUANTIFIERS:
        return NotOfTheElement.NotWatched(), None
    head = f"{fold.function.text}({fold.variable.text} in {fold.list.span.text}"
    meant = f"{head}: {held.condition.span.text}) for {held.duration.span.text}"
    help = NotOfTheElement.WatchedTogether(meant=quoted(meant))
    return help, rewritten(fold, meant, context)
