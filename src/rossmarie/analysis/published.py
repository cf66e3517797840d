"""Messages that rules publish on topics that rules read, in the form in which inputs receive
them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from rossmarie.ir import (
    POINTS,
    Array,
    Beams,
    ByName,
    ChannelValues,
    Doing,
    Each,
    FieldKind,
    Listed,
    Machine,
    Path,
    Points,
    Quantity,
    Sector,
    Slot,
)
from rossmarie.ir.beams import is_of_scan
from rossmarie.ir.reactions import Publish, Scalar
from rossmarie.ir.skills import SkillContext, answer


@dataclass(frozen=True)
class Publisher:
    """A task of a rule that publishes on the topic of a channel. `is_sure` is True if the task
    starts whenever its rule does: no earlier task is awaited, and the task follows no failure.
    """

    rule: int
    task: int
    channel: int
    is_sure: bool


def publications(machine: Machine) -> Iterator[Publisher]:
    """All tasks that publish a message that an input reads."""
    topics = {channel.topic: index for index, channel in enumerate(machine.channels)}
    for rule, plan in enumerate(machine.reactions.plans):
        first = plan.stages[0] if plan.stages else ()
        for task in plan.tasks:
            effect = machine.reactions.tasks[task].effect
            if isinstance(effect, Publish) and effect.topic in topics:
                yield Publisher(rule, task, topics[effect.topic], task in first)


def values_of(machine: Machine, task: int, channel: int) -> ChannelValues:
    """The numbers of the message that a task publishes. Unnamed fields are zero, false or empty."""
    effect = machine.reactions.tasks[task].effect
    assert isinstance(effect, Publish)
    given: Given = {each.path: each.value for each in effect.assignments}
    slots = {
        index: _number(machine, slot, given)
        for index, slot in enumerate(machine.slots)
        if machine.inputs[slot.input].channel == channel
    }
    arrays = {
        index: _numbers(array, given)
        for index, array in enumerate(machine.arrays)
        if machine.inputs[array.input].channel == channel
        and POINTS not in array.path
        and not is_of_scan(array)
    }  # a cloud without fields, or a scan without beams, has no known values
    return ChannelValues(slots, arrays)


Given = dict[Path, Scalar | tuple[Scalar, ...]]


def _number(machine: Machine, slot: Slot, given: Given) -> float:
    last = slot.path[-1] if slot.path else ""
    if isinstance(last, str | Each | Points | Sector | Beams):
        value = given.get(slot.path, "" if slot.kind is FieldKind.TEXT else 0.0)
        return math.nan if isinstance(value, tuple) else _raw(machine, slot.kind, value)
    if isinstance(last, Doing | Quantity):  # rules publish no lists, so no skill runs
        return answer(last, SkillContext(str(given.get(("digest",), ""))))
    elements = _elements(slot.path[:-1], given)
    place = _place(last, len(elements), given)
    is_there = place is not None and place < len(elements)
    return _raw(machine, slot.kind, elements[place or 0]) if is_there else math.nan


def _place(element: int | ByName | Listed, length: int, given: Given) -> int | None:
    match element:
        case int():
            return element
        case ByName(names=names):
            return element.place(list(map(str, _elements(names, given))), length)
        case Listed():
            return element.place_among(length)


def _elements(path: Path, given: Given) -> tuple[Scalar, ...]:
    value = given.get(path, ())
    return value if isinstance(value, tuple) else (value,)


def _raw(machine: Machine, kind: FieldKind, value: Scalar) -> float:
    match kind:
        case FieldKind.TEXT:
            is_known = value in machine.texts
            return float(machine.texts.index(str(value))) if is_known else -1.0
        case FieldKind.FLAG | FieldKind.REAL:
            return float(value)


def _numbers(array: Array, given: Given) -> list[float]:
    return [float(each) for each in _elements(array.path, given)]
