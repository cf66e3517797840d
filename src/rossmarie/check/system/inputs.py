"""Inputs: their topics, message types, fields, units and timeouts."""

from __future__ import annotations

import dataclasses

from dslkit.diagnostics import Collector, DidYouMean, Fix, listed
from rossmarie.check.expressions.infer import infer
from rossmarie.check.model import CheckedInput
from rossmarie.check.names.fields import has_no_number, select, unit_of, with_unit
from rossmarie.check.operations.operands import duration_ns
from rossmarie.check.scopes.context import Context
from rossmarie.check.system.bounds import read_bound
from rossmarie.check.system.element_names import with_names
from rossmarie.check.system.errors import (
    FieldUnitConflict,
    Here,
    SharedDiagnostics,
    TopicTypeConflict,
    TopicWithoutType,
)
from rossmarie.check.system.field_units import FieldKey, check_one_unit
from rossmarie.check.system.input_frames import framed, with_frame_for_unit
from rossmarie.check.system.model import (
    DeclaredTopic,
    SystemModel,
    contradicts,
    find_message,
    full_name,
    report_conflict,
    type_name,
)
from rossmarie.check.system.skill_numbers import resolve_context_timeout, resolve_number
from rossmarie.check.units.errors import MisplacedUnit
from rossmarie.check.units.quantities import end_of_field, is_same_unit, read_unit
from rossmarie.check.wording.gaps import without
from rossmarie.check.wording.suggestions import rename
from rossmarie.syntax import ast
from rossmarie.types import Message, Type, Unknown, message_value, std_msgs_data
from rossmarie.units import Unit

_DIAGNOSTICS = "/diagnostics"


def resolve_inputs(model: SystemModel, context: Context) -> dict[FieldKey, CheckedInput]:
    """Resolve every input of the program into `context.inputs`. Timeouts follow later. Returns, for
    each field, the first input that states its unit.
    """
    stated: dict[str, ast.Input] = {}
    units: dict[FieldKey, CheckedInput] = {}
    sources: dict[str, ast.Name] = {}
    for written in context.declarations.inputs:
        if written.setting is not None:
            continue  # the constants, and thus this value, are known later
        declaration = with_frame_for_unit(written, context)
        if declaration.number is not None:
            number = resolve_number(declaration, declaration.number, context)
            context.inputs.setdefault(declaration.name.text, number)
            continue
        found = _resolve(declaration, model, context.collector)
        found = framed(found, model.find(declaration.topic.text), sources, context)
        _check_one_type(found, stated, model, context.collector)
        check_one_unit(found, units, context.collector)
        if found.topic == _DIAGNOSTICS:
            warning = SharedDiagnostics(topic=_DIAGNOSTICS)
            context.collector.add(warning.at(declaration.topic.span))
        context.inputs.setdefault(declaration.name.text, found)
    return units


def resolve_timeouts(context: Context) -> None:
    """Compute the timeouts of all inputs. The values of constants are already known."""
    _resolve_context(context)
    for declaration in context.declarations.inputs:
        if declaration.timeout is None:
            continue
        context.enter(None)
        infer(declaration.timeout, context)
        timeout_ns = duration_ns(declaration.timeout, "a timeout", context)
        found = context.inputs[declaration.name.text]
        if found.declaration.name is declaration.name:
            resolved = dataclasses.replace(found, timeout_ns=timeout_ns)
            context.inputs[declaration.name.text] = resolved


def _resolve_context(context: Context) -> None:
    """The timeout of the context of skills, and of its numbers."""
    timeout_ns = resolve_context_timeout(context)
    if context.skills is None:
        return
    if timeout_ns is not None:
        context.skills = dataclasses.replace(context.skills, timeout_ns=timeout_ns)
    for name, found in context.inputs.items():
        if found.query is not None:
            resolved = dataclasses.replace(found, timeout_ns=context.skills.timeout_ns)
            context.inputs[name] = resolved


def _resolve(declaration: ast.Input, model: SystemModel, collector: Collector) -> CheckedInput:
    topic = model.find(declaration.topic.text)
    name = full_name(declaration.topic.text) if topic is None else topic.name
    message = _message(declaration, topic, model, collector)
    if message is None:
        unknown = "" if topic is None else topic.message_type
        return CheckedInput(declaration, name, unknown, (), Unknown(), None)
    type_ = _selected(message_value(message), message, declaration, collector)
    path = tuple(step.text for step in declaration.path)
    data = std_msgs_data(type_)
    if data is not None:
        type_, path = data, (*path, "data")
    field = ".".join((message.name, *path))
    type_ = with_names(type_, field, declaration, collector)
    most = read_bound(declaration, type_, field, collector)
    type_ = _in_unit(type_, field, declaration, topic, collector)
    whole = message_value(message)
    return CheckedInput(declaration, name, message.name, path, type_, None, most, whole=whole)


def _message(
    declaration: ast.Input, topic: DeclaredTopic | None, model: SystemModel, collector: Collector
) -> Message | None:
    written = declaration.message_type
    if written is not None:
        if topic is not None:
            report_conflict(written, topic, collector)
        return find_message(written, model, collector)
    if topic is not None:
        # A mistake in the type of a declared topic is reported at the declaration.
        return find_message(topic.declaration.message_type, model, collector)
    if declaration.topic.text and model.is_whole:
        _report_without_type(declaration.topic, model, collector)
    return None


def _report_without_type(name: ast.Name, model: SystemModel, collector: Collector) -> None:
    finding = TopicWithoutType(topic=name.text)
    near = model.near_topic(name.text)
    topic = full_name(name.text)
    if near is not None:
        collector.add(finding.at(name.span, help=DidYouMean(near=near), fix=rename(name, near)))
    elif model.topics:
        declared = finding.DeclaredTopics(known=listed(tuple(model.topics)))
        help = finding.Declare(topic=topic)
        collector.add(finding.at(name.span, help=help, notes=(declared,)))
    else:
        collector.add(finding.at(name.span, help=finding.NoSystemModel(topic=topic)))


def _selected(type_: Type, message: Message, declaration: ast.Input, collector: Collector) -> Type:
    text = message.name
    before = declaration.message_type or declaration.topic
    for step in declaration.path:
        type_ = select(type_, step, text, before.span, collector)
        before = step
        text = f"{text}.{step.text}"
    return type_


def _in_unit(
    type_: Type,
    field: str,
    declaration: ast.Input,
    topic: DeclaredTopic | None,
    collector: Collector,
) -> Type:
    if isinstance(type_, Unknown):
        return type_
    known = unit_of(type_)
    if declaration.unit is None:
        is_unstated = known is None and topic is not None and topic.unit is not None
        return _rescaled(type_, topic.unit if is_unstated and topic is not None else None)
    unit = read_unit(declaration.unit, collector)
    if unit is None:
        return Unknown()
    if has_no_number(type_):
        _report_no_number(declaration.unit, type_, field, collector)
        return Unknown()
    if topic is not None and topic.unit is not None and not is_same_unit(unit, topic.unit):
        _report_other_unit(declaration.unit, unit, field, topic, collector)
        return Unknown()
    contradiction = contradicts(known, unit, field)
    if contradiction is None:
        return _rescaled(type_, unit)
    edits = without(end_of_field(declaration), "in", declaration.unit.span)
    fix = Fix(f"leave out `in {declaration.unit.text}`", edits)
    collector.add(contradiction.at(declaration.unit.span, fix=fix))
    return Unknown()


def _report_other_unit(
    written: ast.Unit, unit: Unit, field: str, topic: DeclaredTopic, collector: Collector
) -> None:
    """Report that a system model gives the values of a topic another unit than an input does."""
    declared = topic.declaration.unit
    if topic.unit is None or declared is None:
        return
    finding = FieldUnitConflict(
        topic=topic.name, field=field, found=unit.symbol, expected=topic.unit.symbol
    )
    collector.add(finding.at(written.span, Here(what=topic.unit.symbol).at(declared.span)))


def _rescaled(type_: Type, unit: Unit | None) -> Type:
    return type_ if unit is None else with_unit(type_, unit) or type_


def _report_no_number(unit: ast.Unit, type_: Type, field: str, collector: Collector) -> None:
    finding = MisplacedUnit(reason=f"`{field}` is not a number")
    is_message = isinstance(type_, Message)
    kind = finding.ChooseField if is_message else finding.LeaveOut
    collector.add(finding.at(unit.span, help=kind(unit=unit.text)))


def _check_one_type(
    found: CheckedInput, stated: dict[str, ast.Input], model: SystemModel, collector: Collector
) -> None:
    """Report two inputs that state different types of one topic."""
    written = found.declaration.message_type
    if written is None or found.topic in model.topics:
        return
    first = stated.setdefault(found.topic, found.declaration).message_type
    if first is None or type_name(first.text) == type_name(written.text):
        return
    finding = TopicTypeConflict(
        topic=found.topic, found=type_name(written.text), expected=type_name(first.text)
    )
    place = Here(what=type_name(first.text)).at(first.span)
    collector.add(finding.at(written.span, place))
