"""The source and the target frame of an input: `from camera in base`."""

from __future__ import annotations

import dataclasses

from dslkit.diagnostics import Remark
from rossmarie.check.model import CheckedInput
from rossmarie.check.names.fields import members
from rossmarie.check.names.frame_errors import NoPath, NothingToTransform, UnknownSource
from rossmarie.check.names.frames import frame_field, has_frame, is_reported
from rossmarie.check.scopes.context import Context
from rossmarie.check.system.frames import find_frame, report_second_frame
from rossmarie.check.system.model import DeclaredTopic
from rossmarie.syntax import ast
from rossmarie.types import Message, Quantity, Type, Unknown
from rossmarie.units import UnknownUnitError, parse_unit


def with_frame_for_unit(declaration: ast.Input, context: Context) -> ast.Input:
    """The input with its target frame, if the only `in` is not a unit."""
    unit = declaration.unit
    if declaration.frame is not None or unit is None or not context.frames.frames:
        return declaration
    if _is_unit(unit.text):
        return declaration
    frame = ast.Name(unit.text, unit.span)
    return dataclasses.replace(declaration, unit=None, frame=frame)


def _is_unit(text: str) -> bool:
    try:
        parse_unit(text)
    except UnknownUnitError:
        return False
    return True


def framed(
    used: CheckedInput, topic: DeclaredTopic | None, first: dict[str, ast.Name], context: Context
) -> CheckedInput:
    """The input with its frames. `first` contains the frames that earlier inputs gave to topics."""
    source = _source(used, topic, first, context)
    target = None
    written = used.declaration.frame
    if written is not None and not isinstance(used.type, Unknown):
        target = find_frame(written, context)
    if written is None or target is None:
        return dataclasses.replace(used, source=source)
    if not _can_be_seen(used, written, context):
        return dataclasses.replace(used, type=Unknown())
    if source is None:
        finding = UnknownSource(field=used.field, frame=written.text)
        context.collector.add(finding.at(written.span))
        return dataclasses.replace(used, type=Unknown())
    if context.frames.path(source, target) is None:
        _report_no_path(used, source, written, topic, context)
        return dataclasses.replace(used, type=Unknown())
    return dataclasses.replace(used, source=source, target=target)


def _source(
    used: CheckedInput, topic: DeclaredTopic | None, first: dict[str, ast.Name], context: Context
) -> str | None:
    """The frame in which an input arrives: the frame after its own `from`, or else the frame of its
    topic.
    """
    written = used.declaration.source
    is_of_header = frame_field(used.whole, used.path) == frame_field(used.whole, ())
    declared = None
    if is_of_header and topic is not None:
        declared = topic.declaration.source
    if is_of_header and declared is None:
        declared = first.get(used.topic)
    if written is None:
        reported = None if topic is None or not is_of_header else topic.declaration.source
        return None if reported is None else context.frames.named(reported.text)
    found = context.frames.named(written.text)
    if declared is not None:
        expected = context.frames.named(declared.text)
        if expected != found:
            subject = f"the header of {used.topic}"
            report_second_frame(subject, written, found, declared, expected, context)
    elif is_of_header:
        first[used.topic] = written
    return found


def _can_be_seen(used: CheckedInput, written: ast.Name, context: Context) -> bool:
    """Say whether an input has a value that can be transformed to another frame."""
    reason, help = _trouble(used, written.text)
    if reason is not None:
        finding = NothingToTransform(field=used.field, frame=written.text, reason=reason)
        context.collector.add(finding.at(written.span, help=help))
    return reason is None


def _trouble(used: CheckedInput, frame: str) -> tuple[str | None, Remark | None]:
    """The reason why an input cannot be transformed to another frame, and the help; None if it
    can.
    """
    type_, path = used.type, used.declaration.path
    leave_out = NothingToTransform.LeaveOut(frame=frame)
    if isinstance(type_, Quantity) and len(path) > 1 and path[-1].text in "xyzw":
        whole = ".".join(each.text for each in path[:-1])
        return "it is one component", NothingToTransform.Whole(field=whole)
    if not has_frame(type_):
        return "it has no position, orientation or vector", leave_out
    other = _in_another_frame(used, type_)
    if other is not None:
        field = NothingToTransform.Field(field=other)
        return f"its field `{other}` is in a frame of its own", field
    return None, None


def _in_another_frame(used: CheckedInput, type_: Type) -> str | None:
    """A field whose frame is in another field than the frame of the whole message; None if there is
    none.
    """
    for name, part in members(type_).items():
        is_seen = isinstance(type_, Message) and has_frame(part)
        if is_seen and not is_reported(used, (*used.path, name)):
            return name
    return None


def _report_no_path(
    used: CheckedInput,
    source: str,
    written: ast.Name,
    topic: DeclaredTopic | None,
    context: Context,
) -> None:
    finding = NoPath(source=source, target=context.frames.named(written.text))
    origin = used.declaration.source
    if origin is None and topic is not None:
        origin = topic.declaration.source
    places = () if origin is None else (finding.From(source=source).at(origin.span),)
    context.collector.add(finding.at(written.span, *places))
