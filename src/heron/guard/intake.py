"""Conversion of messages to the inputs of the guard's core: one function per topic, created
once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from operator import attrgetter, itemgetter
from typing import Any

import numpy as np

from heron import messages
from heron.guard.attributes import Read, attributes_of
from heron.messages import Message
from rossmarie.guard import Core, Value
from rossmarie.ir import (
    NEVER_NS,
    Array,
    Beams,
    ByName,
    Doing,
    Each,
    Edge,
    Listed,
    Machine,
    Path,
    Points,
    Quantity,
    Reported,
    Sector,
    Slot,
    arrival_names,
    bare_frame,
    field_names,
    scan_names,
)
from rossmarie.ir.beams import scan_path
from rossmarie.ir.skills import answer

_UNKNOWN = messages.new_message("geometry_msgs/Transform")
for _part, _axes in ((_UNKNOWN.translation, "xyz"), (_UNKNOWN.rotation, "xyzw")):
    for _axis in _axes:
        setattr(_part, _axis, math.nan)

Watch = Callable[..., "int | None"]
"""Takes an instant and these fields. Returns the instant of the next call, or None if the core has
reports.
"""


class FieldReaders:
    """The fields that rules read of each topic, and their readers, made once for all episodes.
    `readers` are the fastest functions, or None if fields are read by their names.
    """

    def __init__(self, machine: Machine) -> None:
        self._machine = machine
        channels = range(len(machine.channels))
        self.fields = [self._named_fields(channel) for channel in channels]
        self.readers = [self._reader(channel) for channel in channels]

    def _reader(self, channel: int) -> Read | None:
        machine = self._machine
        paths = [slot.path for slot in self._on(channel, machine.slots)]
        arrays = [array.path for array in self._on(channel, machine.arrays)]
        if paths and all(isinstance(path[-1], Doing | Quantity) for path in paths):
            return _reader(paths, arrays)
        empty = messages.new_message(machine.channels[channel].message_type)
        is_plain = all(_is_plain(empty, path) for path in paths)
        if not is_plain or not all(_are_floats(empty, path) for path in arrays):
            return None
        return _reader(paths, arrays)

    def _named_fields(self, channel: int) -> dict[str, Path | None]:
        """The fields of a channel, as the core calls them; None for an input of which only the age
        is read.
        """
        machine = self._machine
        slots, arrays = field_names(machine)
        named: list[tuple[frozenset[str], Slot | Array]]
        named = [*zip(slots, machine.slots, strict=True), *zip(arrays, machine.arrays, strict=True)]
        fields: dict[str, Path | None] = {
            max(names, key=len): field.path
            for names, field in named
            if machine.inputs[field.input].channel == channel and scan_path(field.path) is None
        }
        scans: dict[str, Path | None] = {  # sectors and points are taken of the whole scan
            name: scan.path
            for name, scan in scan_names(machine).items()
            if machine.inputs[scan.input].channel == channel
        }
        ages = arrival_names(machine).items()
        return fields | scans | {name: None for name, arriving in ages if arriving == channel}

    def _on(self, channel: int, fields: Sequence[Slot] | Sequence[Array]) -> list[Slot | Array]:
        inputs = self._machine.inputs
        return [field for field in fields if inputs[field.input].channel == channel]


class Intake:
    """The path of messages on all topics into a core."""

    def __init__(self, core: Core, readings: FieldReaders) -> None:
        self._core = core
        self._readings = readings
        self._reported: Reported | None = None

    def watch(self, channel: int) -> tuple[Read, Watch]:
        """The fastest path from a message on a channel into the core."""
        read = self._readings.readers[channel]
        if read is None:
            return lambda message: (message,), partial(self._slowly, channel)
        return read, self._core.watch_call(self._core.machine.channels[channel].topic)

    def take(self) -> Reported:
        """The findings of the calls that `watch` gave, since the last time."""
        reported, self._reported = self._reported, None
        return self._core.take() if reported is None else reported

    def together(self, at_ns: int, messages: Mapping[int, Message]) -> Reported:
        """Handle messages of several channels that arrive together. Returns the events of
        the core.
        """
        values: dict[str, Value] = {}
        for channel, message in messages.items():
            values |= self._values(channel, message)
        return self._core.update(at_ns, values)

    def _slowly(self, channel: int, at_ns: int, message: Message) -> int | None:
        reported = self._core.update(at_ns, self._values(channel, message))
        if reported:
            self._reported = reported
            return None
        wake_ns = self._core.next_wake()
        return NEVER_NS if wake_ns is None else wake_ns

    def _values(self, channel: int, message: Message) -> dict[str, Value]:
        fields = self._readings.fields[channel]
        return {
            name: 1.0 if path is None else _value(message, path) for name, path in fields.items()
        }


def transforms_in(message: Message, edges: Mapping[int, Edge]) -> dict[int, Message]:
    """The transforms of a message that the rules need, by their channels: the last transform of
    each frame. A transform to another parent is unknown (S79).
    """
    found = {}
    for each in message.transforms:
        parent, child = bare_frame(each.header.frame_id), bare_frame(each.child_frame_id)
        for channel, edge in edges.items():
            if edge.child == child:
                found[channel] = each.transform if edge.parent == parent else _UNKNOWN
    return found


def _is_plain(empty: Message, path: Path) -> bool:
    """Return True if the field is a single number or flag. Elements must be elements of arrays of
    numbers.
    """
    *parents, last = path
    if not all(isinstance(part, str) for part in parents):
        return False
    if not isinstance(last, str):
        return isinstance(_value(empty, tuple(parents)), np.ndarray)
    return isinstance(_field(empty, path), int | float)


def _are_floats(empty: Message, path: Path) -> bool:
    """Say whether a field is an array of floats, as the core takes it."""
    if not all(isinstance(part, str) for part in path):
        return False
    found = _value(empty, path)
    return isinstance(found, np.ndarray) and found.dtype in (np.float64, np.float32)


def _reader(paths: Sequence[Path], arrays: Sequence[Path]) -> Read:
    """A function that gives all fields at these paths, the arrays last."""
    if all(isinstance(path[-1], str) for path in paths):
        return attributes_of([tuple(map(str, path)) for path in (*paths, *arrays)])
    if not arrays and len({path[:-1] for path in paths}) == 1:
        places = [path[-1] for path in paths if isinstance(path[-1], int)]
        if len(places) == len(paths):
            return _elements(".".join(map(str, paths[0][:-1])), places)
    every = (*paths, *arrays)
    return lambda message: [_field(message, path) for path in every]


def _elements(attribute: str, places: Sequence[int]) -> Callable[[Message], Sequence[float]]:
    """A function that gives some elements of one array; NaN for those that are not there."""
    get, least = attrgetter(attribute), max(places) + 1
    pick = itemgetter(*places, 0)  # a tuple, also of a single one

    def read(message: Message) -> Sequence[float]:
        numbers = get(message).tolist()
        if len(numbers) < least:
            numbers += [math.nan] * (least - len(numbers))
        found: tuple[float, ...] = pick(numbers)
        return found[:-1]

    return read


def _field(message: Message, path: Path) -> Any:
    """The value to which a path leads; NaN for an element that is not there."""
    value = message
    for step, part in enumerate(path):
        if isinstance(part, str):
            value = getattr(value, part)
            continue
        if isinstance(part, Each):
            return [_field(each, path[step + 1 :]) for each in value]
        if isinstance(part, Doing | Quantity):
            return answer(part, value)
        assert not isinstance(part, Points), "Heron has no sensor that sends clouds"
        assert not isinstance(part, Sector | Beams), "read from the whole scan"
        place = _place(message, part, len(value))
        if place is None or place >= len(value):
            return math.nan
        value = value[place]
    return value


def _place(message: Message, element: int | ByName | Listed, length: int) -> int | None:
    """The place of an element in an array of a length."""
    match element:
        case int():
            return element
        case ByName(names=names):
            return element.place(attrgetter(".".join(names))(message), length)
        case Listed():
            return element.place_among(length)


def _value(message: Message, path: Path) -> Value:
    """A field; NaN for an element that is not there, seconds for an instant."""
    value = _field(message, path)
    if isinstance(value, messages.Time):
        return float(value.sec) + value.nanosec * 1e-9
    found: Value = value
    return found
