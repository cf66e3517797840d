"""Fields of messages that effects name: the path to each, and its type."""

from __future__ import annotations

from dataclasses import dataclass

from rossmarie.check.actions.targets import SentMessage, TargetResolver
from rossmarie.check.names.fields import members, select, unit_of
from rossmarie.ir import reactions
from rossmarie.syntax import ast
from rossmarie.types import (
    Array,
    Boolean,
    Leaf,
    Message,
    Quantity,
    Type,
    Unknown,
    message_value,
    std_msgs_data,
)
from rossmarie.units import DIMENSIONLESS, Unit


@dataclass(frozen=True)
class EffectField:
    """A field that an effect names. `leaf` is None if the field is a message itself. `is_element`
    is True if the path selects an element of an array.
    """

    text: str
    path: reactions.FieldPath
    type: Type
    leaf: Leaf | None
    unit: Unit | None
    is_element: bool


def field_of(path: ast.FieldPath, sent: SentMessage, targets: TargetResolver) -> EffectField | None:
    """The field that a path leads to; None after reporting that there is no such field."""
    type_: Type = message_value(sent.message)
    text, before = sent.type, path.span
    names: list[str] = []
    is_element = False
    for step in path.steps:
        if isinstance(step, ast.Position):
            is_element = True
            type_ = type_.element if isinstance(type_, Array) else type_
            continue
        found = members(type_).get(step.text)
        if found is None:
            type_ = select(type_, step, text, before, targets.context.collector)
        else:
            type_ = found
        if isinstance(type_, Unknown):
            return None
        text, before = f"{text}.{step.text}", step.span
        names.append(step.text)
    leaves = targets.model.messages.leaves(sent.message)
    leaf = next((leaf for leaf in leaves if leaf.path == tuple(names)), None)
    steps = tuple(
        step.index if isinstance(step, ast.Position) else step.text for step in path.steps
    )
    unit = _stated_unit(sent, targets) or unit_of(type_)
    return EffectField(path.span.text, steps, type_, leaf, unit, is_element)


def leaf_unit(leaf: Leaf, sent: SentMessage, targets: TargetResolver) -> Unit | None:
    """The unit of a number in a message."""
    type_: Type = message_value(sent.message)
    for name in leaf.path:
        type_ = members(type_).get(name, Unknown())
    return _stated_unit(sent, targets) or unit_of(type_)


def _stated_unit(sent: SentMessage, targets: TargetResolver) -> Unit | None:
    """The unit that a system model gives a topic of a std_msgs value."""
    topic = targets.model.topics.get(sent.name)
    is_value = std_msgs_data(sent.message) is not None
    return topic.unit if topic is not None and is_value else None


def symbol_of(unit: Unit | None) -> str:
    """The symbol of a unit; empty for plain numbers and unknown units."""
    return "" if unit is None or unit == DIMENSIONLESS else unit.symbol


def describe_field(field: EffectField) -> str:
    """`in m/s`, `a plain number`, `a string`, `true or false`."""
    element = field.type.element if isinstance(field.type, Array) else field.type
    if isinstance(element, Boolean):
        return "true or false"
    if isinstance(element, Quantity):
        if field.unit is None:
            return "of unknown unit"
        return f"in {field.unit.symbol}" if symbol_of(field.unit) else "a plain number"
    return f"a message {element.name}" if isinstance(element, Message) else "a string"
