"""The frames of system models, and the source and target frames of inputs."""

from __future__ import annotations

import dataclasses
import math

from dslkit.diagnostics import DeclaredHere, DidYouMean, Remark
from dslkit.source import Span
from rossmarie.check.expressions.infer import infer
from rossmarie.check.frames import LONGEST_NS, CheckedFrame, FrameTree, named_inputs
from rossmarie.check.model import CheckedInput
from rossmarie.check.names.frame_errors import (
    CircularFrames,
    FrameConflict,
    UnfitPlacement,
    UnknownFrame,
)
from rossmarie.check.operations.operands import duration_ns, require_constant, scalar_operand
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.declarations import report_second
from rossmarie.check.scopes.errors import DuplicateName
from rossmarie.check.scopes.trees import text_of
from rossmarie.check.system.errors import Here
from rossmarie.check.units.quantities import read_unit
from rossmarie.check.wording.describe import describe, is_plain
from rossmarie.check.wording.suggestions import near_name, rename
from rossmarie.ir import Edge, bare_frame
from rossmarie.syntax import ast
from rossmarie.types import Quantity, Type, Unknown, message_value, unit_faults
from rossmarie.units import parse_unit

TRANSFORM = "geometry_msgs/Transform"
_METRE, _RADIAN = parse_unit("m"), parse_unit("rad")
_FORMS = {"at": "`at [0.3, 0, 0.5] m`", "turned": "`turned [0, 20, 180] deg`: roll, pitch, yaw"}
_MOST = {"at": (1e6, "1000 km"), "turned": (2.0 * math.pi + 1e-9, "a full turn")}
"""The largest distances and angles, in m and rad, with the words for each of them."""
_AXES = 3


def read_frames(context: Context) -> None:
    """Collect the frames of all system models in `context.frames`. Their numbers follow later."""
    tree = context.frames
    declared = [
        member
        for system in context.declarations.systems
        for member in system.members
        if isinstance(member, ast.FrameDeclaration)
    ]
    for each in declared:
        if each.alias is not None:
            _add_alias(each.alias, each, tree, context)
    for each in declared:
        _add(each, tree, context)
    _check_circles(tree, context)
    names = named_inputs(tree, context.declarations.names)
    for frame, name in names.items():
        context.frame_inputs[frame] = _input_of(tree.frames[frame], name, context)


def _add_alias(
    alias: ast.Name, declared: ast.FrameDeclaration, tree: FrameTree, context: Context
) -> None:
    expected = tree.aliases.setdefault(alias.text, declared.frame.text)
    if expected != declared.frame.text:
        finding = DuplicateName(
            identifier=alias.text,
            kind="alias",
            other=f"frame {expected}",
            reason="an alias stands for one frame",
        )
        context.collector.add(finding.at(alias.span))


def _add(declared: ast.FrameDeclaration, tree: FrameTree, context: Context) -> None:
    name = tree.named(declared.frame.text)
    frame = CheckedFrame(declared, name, tree.named(declared.parent.text))
    first = tree.frames.setdefault(name, frame)
    if first is frame:
        return
    if first.parent == frame.parent:
        reason = "a frame needs exactly one declaration"
        earlier = first.declaration.frame
        report_second(declared.frame, earlier, "frame", reason, context.collector)
        return
    finding = FrameConflict(
        subject=f"the frame `{name}`",
        found=frame.parent,
        expected=first.parent,
        words="a second declaration of this frame",
    )
    place = DeclaredHere().at(first.declaration.frame.span)
    context.collector.add(finding.at(declared.frame.span, place))


def _check_circles(tree: FrameTree, context: Context) -> None:
    reported: set[str] = set()
    for start in list(tree.frames):
        steps = [start]
        while steps[-1] in tree.frames and len(steps) <= len(tree.frames):
            steps.append(tree.frames[steps[-1]].parent)
            if steps[-1] == start:
                break
        if len(steps) == 1 or steps[-1] != start or start in reported:
            continue
        reported.update(steps)
        finding = CircularFrames(identifier=start, cycle=" in ".join(f"`{each}`" for each in steps))
        context.collector.add(finding.at(tree.frames[start].declaration.frame.span))
    for name in reported:  # so that paths end
        del tree.frames[name]


def _input_of(frame: CheckedFrame, name: str, context: Context) -> CheckedInput:
    """The input for a frame. No rule declares it."""
    topic, span = frame.topic, frame.declaration.frame.span
    assert topic is not None, "a mounted frame has no topic"
    edge = Edge(topic, bare_frame(frame.parent), bare_frame(frame.name))
    declaration = ast.Input(
        ast.Name(name, span), ast.Name(str(edge), span), None, (), None, None, None, None, span
    )
    found = None if context.messages is None else context.messages.find(TRANSFORM)
    type_: Type = Unknown() if found is None else message_value(found)
    return CheckedInput(
        declaration, str(edge), TRANSFORM, (), type_, LONGEST_NS, whole=type_, edge=edge
    )


# --- numbers ---------------------------------------------------------------------------------


def resolve_frames(context: Context) -> None:
    """Compute the numbers of all frames. The values of constants are already known."""
    for name, frame in context.frames.frames.items():
        context.enter(None)
        declared = frame.declaration
        if declared.at is not None or declared.turned is not None:
            place = _numbers("at", declared.at, frame, context)
            angles = _numbers("turned", declared.turned, frame, context)
            turn = quaternion(*angles)
            resolved = dataclasses.replace(frame, mounted=(*place, *turn))
            if declared.timeout is not None:
                _report(
                    "timeout", frame, declared.timeout.span, "has no meaning for a mounted frame",
                    "either a timeout or a place", "remove one of the two", context,
                )  # fmt: skip
        elif declared.timeout is not None:
            infer(declared.timeout, context)
            timeout_ns = duration_ns(declared.timeout, "a timeout", context)
            resolved = dataclasses.replace(frame, timeout_ns=timeout_ns)
            used = context.frame_inputs[name]
            context.frame_inputs[name] = dataclasses.replace(used, timeout_ns=timeout_ns)
        else:
            continue
        context.frames.frames[name] = resolved


def quaternion(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """The rotation by three angles in rad about the fixed axes x, y and z, in this order (REP
    103).
    """
    (sr, cr), (sp, cp), (sy, cy) = (
        (math.sin(each / 2.0), math.cos(each / 2.0)) for each in (roll, pitch, yaw)
    )
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def _numbers(
    word: str, node: ast.Expression | None, frame: CheckedFrame, context: Context
) -> tuple[float, float, float]:
    """The three numbers after a word in SI. A wrong number is reported and becomes 0."""
    nothing = (0.0, 0.0, 0.0)
    if node is None:
        return nothing
    if not isinstance(node, ast.Bracket) or len(node.elements) != _AXES:
        infer(node, context)
        count = len(node.elements) if isinstance(node, ast.Bracket) else 1
        found = "one value" if count == 1 else f"a list of {count}"
        reason = "is three numbers"
        _report(word, frame, node.span, reason, found, _FORMS[word], context)
        return nothing
    around = None if node.unit is None else read_unit(node.unit, context.collector)
    if node.unit is not None and around is None:
        return nothing
    expected = Quantity(_METRE if word == "at" else _RADIAN)
    found_numbers = []
    for element in node.elements:
        infer(element, context)
        operand = scalar_operand(element, context)
        if operand is None or not require_constant(element, f"`{word}`", context):
            return nothing
        number = context.values[element].numbers[0]
        quantity = operand.quantity
        if around is not None and is_plain(quantity):
            number, quantity = around.to_si(number), Quantity(around)
        is_zero = number == 0.0 and is_plain(quantity)
        if not is_zero and unit_faults(quantity, expected):
            kind = "three lengths" if word == "at" else "three angles"
            _report(
                word, frame, element.span, f"is {kind}", describe(quantity), _FORMS[word], context
            )
            return nothing
        most, limit = _MOST[word]
        if not abs(number) <= most:
            found, reason = f"`{text_of(element)}`", f"is at most {limit}"
            _report(word, frame, element.span, reason, found, _FORMS[word], context)
            return nothing
        found_numbers.append(number)
    x, y, z = found_numbers
    return x, y, z


def _report(
    word: str, frame: CheckedFrame, span: Span, reason: str, found: str, form: str,
    context: Context,
) -> None:  # fmt: skip
    finding = UnfitPlacement(word=word, frame=frame.name, reason=reason, found=found, form=form)
    context.collector.add(finding.at(span))


# --- names -----------------------------------------------------------------------------------


def find_frame(written: ast.Name, context: Context) -> str | None:
    """The name in headers of a frame that a system model has to declare; None after reporting that
    no system model does.
    """
    name = context.frames.named(written.text)
    if name in context.frames:
        return name
    if context.declarations.is_whole:
        finding = UnknownFrame(identifier=written.text)
        near = near_name(written.text, context.frames.names) if context.may_suggest() else None
        if near is None:
            context.collector.add(finding.at(written.span))
        else:
            help: Remark = DidYouMean(near=near)
            context.collector.add(finding.at(written.span, help=help, fix=rename(written, near)))
    return None


def report_second_frame(
    subject: str, written: ast.Name, found: str, first: ast.Name, expected: str, context: Context
) -> None:
    """Report two declarations of the frame of one subject."""
    finding = FrameConflict(
        subject=subject, found=found, expected=expected, words=f"`{found}` here"
    )
    place = Here(what=f"`{expected}`").at(first.span)
    context.collector.add(finding.at(written.span, place))
