"""The frame of an expression, and expressions that need a common frame."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from rossmarie.check.model import CheckedInput
from rossmarie.check.names.frame_errors import MixedFrames, NothingToTransform, Seen
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import path_of, root_of, stripped, text_of
from rossmarie.core import Sampling
from rossmarie.ir.path import EACH, Path
from rossmarie.syntax import ast
from rossmarie.types import (
    Array,
    Beam,
    List,
    Message,
    Quaternion,
    ScanPoint,
    Text,
    Type,
    Vector,
)

HEADER = ("header", "frame_id")
CHILD = "child_frame_id"
"""The field of a nav_msgs/Odometry with the frame of its twist."""

_KEEPING = {"abs", "min", "max", "roll", "pitch", "yaw", *(each.value for each in Sampling)}
"""Functions whose result has the frame of the object that they are called on."""


class Framed(NamedTuple):
    """A frame, and the input whose value is in this frame."""

    frame: str
    used: CheckedInput


def frame_field(whole: Type | None, path: Sequence[object]) -> Path | None:
    """The field with the frame of a part of a message; None if there is no such field. It belongs
    to the innermost header around the part. For elements of a list, it belongs to the message with
    the list, unless that message has no header and each element has its own (S77).
    """
    found: Path | None = None
    type_ = whole
    before: Path = ()
    for step in (*path, None):
        if isinstance(type_, List):
            type_, before = type_.element, (*before, EACH)
            if found is not None or not isinstance(type_, Message):
                break
            if step is EACH:
                continue
        if not isinstance(type_, Message):
            break
        if _has_header(type_):
            is_twist = step == "twist" and isinstance(type_.fields.get(CHILD), Text)
            found = (*before, CHILD) if is_twist else (*before, *HEADER)
        if not isinstance(step, str):
            break
        type_ = type_.fields.get(step)
        before = (*before, step)
    return found


def _has_header(message: Message) -> bool:
    header = message.fields.get(HEADER[0])
    return isinstance(header, Message) and isinstance(header.fields.get(HEADER[1]), Text)


def is_reported(used: CheckedInput, path: Sequence[object]) -> bool:
    """Say whether the frame of an input also applies to the part at a path, because the same field
    of the message contains the frame of both.
    """
    return frame_field(used.whole, path) == frame_field(used.whole, used.path)


def has_frame(type_: Type) -> bool:
    """Say whether values of a type have a frame, or contain values that have one."""
    match type_:
        case Vector() | Quaternion():
            return True
        case List(element=element):
            return has_frame(element)
        case Message(fields=fields):
            return any(has_frame(part) for name, part in fields.items() if name != HEADER[0])
        case _:  # open: numbers, booleans and texts have no frame
            return False


def frame_of(node: ast.Expression, context: Context) -> Framed | None:
    """The frame of an expression; None if it is unknown, or if the expression has no frame."""
    node = stripped(node)
    match node:
        case ast.Reference() | ast.Member() | ast.Index():
            return _of_part(node, context)
        case ast.Unary(operand=operand):
            return frame_of(operand, context)
        case ast.Binary(operator=ast.BinaryOperator.ADD | ast.BinaryOperator.SUBTRACT):
            return _of_sum(node, context)
        case ast.Binary(
            operator=ast.BinaryOperator.MULTIPLY | ast.BinaryOperator.DIVIDE, left=left, right=right
        ):
            found = [frame_of(side, context) for side in (left, right)]
            known = [each for each in found if each is not None]
            return known[0] if len({each.frame for each in known}) == 1 else None
        case ast.Call(function=function, arguments=arguments) if function.text in _KEEPING:
            frames = (frame_of(each, context) for each in arguments)
            return next((each for each in frames if each is not None), None)
        case _:  # open: a length, a boolean or a literal has no frame
            return None


def _of_sum(node: ast.Binary, context: Context) -> Framed | None:
    """The frame of a chain `a + b - c`, found without recursion along the chain."""
    current: ast.Expression = node
    while isinstance(current, ast.Binary) and current.operator in (
        ast.BinaryOperator.ADD,
        ast.BinaryOperator.SUBTRACT,
    ):
        found = frame_of(current.right, context)
        if found is not None:
            return found
        current = stripped(current.left)
    return frame_of(current, context)


def _of_part(node: ast.Reference | ast.Member | ast.Index, context: Context) -> Framed | None:
    owner = stripped(node.value) if isinstance(node, ast.Member) else None
    if owner is not None and isinstance(context.type_of(owner), Vector | Quaternion):
        return frame_of(owner, context)  # a component has the frame of its vector
    if not has_frame(context.type_of(node)):
        return None
    used, path = _brought(node, context)
    if used is None or used.frame is None or not is_reported(used, (*used.path, *path)):
        return None
    return Framed(used.frame, used)


def _brought(
    node: ast.Expression, context: Context
) -> tuple[CheckedInput | None, tuple[object, ...]]:
    """The input with a part of a message, or with an element of a list, and the path to that
    part.
    """
    root, path = root_of(node), path_of(node)
    fold = None if root is None else context.folds_around(node).get(root.name.text)
    if fold is not None:
        root, path = root_of(fold.list), (*path_of(fold.list), *path)
    return None if root is None else context.inputs.get(root.name.text), path


def is_left_in_its_frame(node: ast.Member | ast.Sector, type_: Type, context: Context) -> bool:
    """Say whether a value uses the axes of its message, although the rules give another frame: the
    covariance of a pose or a twist, a sector of a scan, the angle of a beam. This is reported.
    """
    used, path = _brought(node.value, context)
    if used is None or used.target is None:
        return False
    match node:
        case ast.Sector():
            names, span = path, node.arc.span
        case ast.Member(member=member) if _goes_by_axes(context.type_of(node.value), member, type_):
            is_covariance = isinstance(type_, Array)  # a beam needs its whole list
            names, span = (*path, member.text) if is_covariance else path, member.span
        case ast.Member():
            return False
    reason = "its axes belong to its message"
    finding = NothingToTransform(field=text_of(node), frame=used.target, reason=reason)
    fields = [each for each in (*used.path, *names) if isinstance(each, str)]
    context.collector.add(finding.at(span, help=finding.Untransformed(field=".".join(fields))))
    return True


def _goes_by_axes(owner: Type, member: ast.Name, type_: Type) -> bool:
    if isinstance(owner, Beam | ScanPoint):
        return member.text == "angle"
    return isinstance(type_, Array) and member.text.endswith("covariance")


def check_one_frame(operands: Sequence[ast.Expression], context: Context) -> bool:
    """Say whether no two expressions have different frames. Two expressions that differ are
    reported.
    """
    first: tuple[ast.Expression, Framed] | None = None
    for node in operands:
        found = frame_of(node, context)
        if found is None:
            continue
        if first is None:
            first = node, found
        elif found.frame != first[1].frame:
            _report(node, found, *first, context)
            return False
    return True


def check_frame_is(
    node: ast.Expression, frame: str, other: ast.Expression, context: Context
) -> bool:
    """Say whether the frame of an expression is unknown, or the frame of another quantity. A
    different frame is reported.
    """
    found = frame_of(node, context)
    if found is None or found.frame == frame:
        return True
    _report_in(node, found, other, frame, context)
    return False


def _report(
    node: ast.Expression,
    found: Framed,
    other: ast.Expression,
    expected: Framed,
    context: Context,
) -> None:
    _report_in(node, found, other, expected.frame, context)


def _report_in(
    node: ast.Expression, found: Framed, other: ast.Expression, expected: str, context: Context
) -> None:
    finding = MixedFrames(
        text=text_of(node), found=found.frame, other=text_of(other), expected=expected
    )
    place = Seen(text=text_of(other), frame=expected).at(other.span)
    name, source = found.used.declaration.name.text, found.used.source or found.frame
    is_known = context.frames.path(source, expected) is not None
    help = (
        finding.Transform(name=name, expected=expected)
        if is_known
        else finding.Declare(name=name, found=source, expected=expected)
    )
    context.collector.add(finding.at(node.span, place, help=help))
