"""Turn a script into the messages of each instant, in the form that engines take.

A field that was never set has the value of a new ROS message: 0, false, an empty string, no
elements. Orientations are upright. A set value stays until it is set again. A list has the elements
whose fields were set, and all elements before them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import groupby

from rossmarie.ir import (
    AXES,
    EACH,
    POINTS,
    Array,
    ByName,
    ChannelValues,
    Doing,
    FieldKind,
    Listed,
    Machine,
    Path,
    Quantity,
    Sector,
    Slot,
    columns_of,
)
from rossmarie.ir.beams import is_of_scan, scan_path
from rossmarie.ir.carried import raw_of
from rossmarie.ir.path import extent
from rossmarie.ir.script import FieldValue, Script, ScriptedArrival, ScriptedReset, SettingValue
from rossmarie.ir.skills import RunningSkill, SkillContext, answer
from rossmarie.testing.frames import asked_frames
from rossmarie.testing.orientation import UPRIGHT, with_angle
from rossmarie.testing.scans import arrays_of_scans, set_sector, usual_scans

_Field = tuple[str, Path]


@dataclass(frozen=True)
class InstantEvents:
    """The events at one instant: messages by channel, followed by resets."""

    at_ns: int
    messages: Mapping[int, ChannelValues]
    resets: tuple[int | None, ...] = ()


def steps_of(machine: Machine, script: Script) -> Iterator[InstantEvents]:
    """The steps of a script, in order. All messages of one instant form one step, after the
    settings of all statements at this instant, in their order.
    """
    occurrences = [
        (at_ns, order, event)
        for order, event in enumerate(script.events)
        for at_ns in _instants(event)
    ]
    occurrences.sort(key=lambda each: each[:2])
    sender = _Sender(machine)
    for at_ns, group in groupby(occurrences, key=lambda each: each[0]):
        events = [event for _, _, event in group]
        arrivals = [event for event in events if isinstance(event, ScriptedArrival)]
        resets = tuple(event.rule for event in events if isinstance(event, ScriptedReset))
        yield InstantEvents(at_ns, sender.messages(arrivals), resets)


def _instants(event: ScriptedArrival | ScriptedReset) -> Iterator[int]:
    if isinstance(event, ScriptedReset):
        yield event.at_ns
    elif event.period_ns is None:
        yield event.first_ns
    else:
        yield from range(event.first_ns, event.last_ns + 1, event.period_ns)


@dataclass
class _Sender:
    """Stores the last values. `values` are in SI. `running` are the skills that run and the skills
    that can start next, by topic.
    """

    machine: Machine
    values: dict[_Field, SettingValue] = field(default_factory=dict)
    running: dict[str, tuple[RunningSkill, ...]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.values.update(usual_scans(self.machine))
        self._frames = asked_frames(self.machine)
        self._lists = [(self._topic(each.input), each.path) for each in self.machine.lists]

    def messages(self, arrivals: list[ScriptedArrival]) -> dict[int, ChannelValues]:
        """The messages of one instant, by channel."""
        for arrival in arrivals:
            for setting in arrival.settings:
                self._set(setting)
            if arrival.running is not None:
                self.running[arrival.running.topic] = arrival.running.skills
        topics = {topic for arrival in arrivals for topic in arrival.topics}
        return {
            index: self._message(index)
            for index, channel in enumerate(self.machine.channels)
            if channel.topic in topics
        }

    def _set(self, setting: FieldValue) -> None:
        self._begin_list(setting)
        if setting.angle is not None and isinstance(setting.value, float):
            self._turn(setting, setting.angle, setting.value)
        elif setting.path and isinstance(setting.path[-1], Sector):
            place, readings = set_sector(self.values, setting.topic, setting.path, setting.value)
            self.values[place] = readings
        elif setting.path and isinstance(setting.path[-1], int | Listed):
            self._set_element(setting, setting.path[-1])
        else:
            self.values[setting.topic, setting.path] = setting.value

    def _begin_list(self, setting: FieldValue) -> None:
        """A list without elements, or an unknown list, forgets its elements. A list with an element
        is known.
        """
        for topic, path in self._lists:
            inside = setting.path[: len(path)] == path and topic == setting.topic
            if inside and setting.path == path:
                self.values = {
                    field: value
                    for field, value in self.values.items()
                    if field[0] != topic or field[1][: len(path)] != path
                }
            elif inside:
                self.values.pop((topic, path), None)

    def _turn(self, setting: FieldValue, angle: str, value: float) -> None:
        places = [(setting.topic, (*setting.path, part)) for part in "xyzw"]
        found = [
            self.values.get(place, usual) for place, usual in zip(places, UPRIGHT, strict=True)
        ]
        x, y, z, w = (each if isinstance(each, float) else math.nan for each in found)
        self.values.update(zip(places, with_angle((x, y, z, w), angle, value), strict=True))

    def _set_element(self, setting: FieldValue, element: int | Listed) -> None:
        whole = (setting.topic, setting.path[:-1])
        old = self.values.get(whole)
        elements = list(old) if isinstance(old, tuple) else []
        index, least = extent(element)
        elements += [math.nan] * (least - len(elements))
        elements[index] = _number(setting.value)
        self.values[whole] = tuple(elements)

    def _message(self, channel: int) -> ChannelValues:
        machine = self.machine
        slots = {
            index: self._slot(slot)
            for index, slot in enumerate(machine.slots)
            if machine.inputs[slot.input].channel == channel
        }
        arrays = {}
        for index, array in enumerate(machine.arrays):
            is_alone = array.list is None and not is_of_scan(array)
            if machine.inputs[array.input].channel == channel and is_alone:
                whole = self.values.get((machine.channels[channel].topic, array.path))
                elements = whole if isinstance(whole, tuple) else ()
                arrays[index] = [raw_of(array, each) for each in elements]
        for number, its_list in enumerate(machine.lists):
            is_here = machine.inputs[its_list.input].channel == channel
            if is_here and scan_path(its_list.path) is None:
                arrays |= self._columns(number)
        arrays |= arrays_of_scans(
            machine, self.values, lambda used: machine.inputs[used].channel == channel
        )
        return ChannelValues(slots, arrays)

    def _columns(self, number: int) -> dict[int, list[float]]:
        """The columns of a list; none if the list is unknown or too long."""
        its_list = self.machine.lists[number]
        topic = self._topic(its_list.input)
        size = len(its_list.path)
        if self.values.get((topic, its_list.path), ()) is None:
            return {}
        places = [
            step
            for each, path in self.values
            if each == topic and path[:size] == its_list.path
            for step in path[size : size + 1]
            if isinstance(step, int)
        ]
        count = max(places, default=-1) + 1
        if count > its_list.most:
            return {}
        there = [place for place in range(count) if self._is_there(topic, its_list.path, place)]
        return {
            column: [self._in_element(self.machine.arrays[column], place) for place in there]
            for column in columns_of(self.machine, number)
        }

    def _is_there(self, topic: str, path: Path, place: int) -> bool:
        """S57: say whether a point exists. A point without a position does not exist."""
        if path[-1:] != (POINTS,):
            return True
        axes = (self.values.get((topic, (*path, place, axis)), 0.0) for axis in AXES)
        return not any(math.isnan(_number(axis)) for axis in axes)

    def _in_element(self, column: Array, place: int) -> float:
        path = tuple(place if step == EACH else step for step in column.path)
        return self._scalar(column, path)

    def _topic(self, used: int) -> str:
        return self.machine.channels[self.machine.inputs[used].channel].topic

    def _slot(self, slot: Slot) -> float:
        return self._scalar(slot, slot.path)

    def _scalar(self, source: Slot | Array, path: Path) -> float:
        """A number, a flag or a text in the form that a message carries."""
        value = self._value(self._topic(source.input), path)
        match source.kind:
            case FieldKind.TEXT:
                usual = self._frames.get((self._topic(source.input), source.path), "")
                text = usual if value is _UNSET else value
                texts = self.machine.texts
                return float(texts.index(text)) if isinstance(text, str) and text in texts else -1.0
            case FieldKind.FLAG | FieldKind.REAL if value is _UNSET:
                return 1.0 if path[-1:] == ("w",) else 0.0
            case FieldKind.FLAG:
                return _number(value)
            case FieldKind.REAL:
                return raw_of(source, _number(value))

    def _value(self, topic: str, path: Path) -> SettingValue | object:
        last = path[-1] if path else ""
        if isinstance(last, Doing):
            return answer(last, SkillContext.of(last.export, self.running.get(topic, ())))
        if isinstance(last, Quantity) and not self._is_of_one_skill(topic, last):
            return None
        if isinstance(last, int | Listed):
            whole = self.values.get((topic, path[:-1]))
            elements = whole if isinstance(whole, tuple) else ()
            place = last if isinstance(last, int) else last.place_among(len(elements))
            return elements[place] if place is not None and place < len(elements) else None
        # A message without a name has no element with this name. Without skills, there is no
        # quantity.
        is_lacking = isinstance(last, ByName | Quantity)
        return self.values.get((topic, path), None if is_lacking else _UNSET)

    def _is_of_one_skill(self, topic: str, asked: Quantity) -> bool:
        """Say whether a quantity is possible: exactly one running skill has it, or the running
        skills are unknown.
        """
        if topic not in self.running:
            return True
        running = [each for each in self.running[topic] if not each.is_ahead]
        return sum(each.skill in asked.skills for each in running) == 1


_UNSET = object()


def _number(value: object) -> float:
    return float(value) if isinstance(value, float | bool) else math.nan
