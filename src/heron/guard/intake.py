"""From messages to what the core of a guard takes in: one function for each topic, made once."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from operator import attrgetter
from typing import Any

import numpy as np

from heron import messages
from heron.messages import Message
from rossmarie.guard import Core, Value
from rossmarie.ir import Array, ByName, Each, Listed, Path, Slot, Told, arrival_names, field_names

Take = Callable[[int, Message], Told | None]
"""An instant and a message; gives what the core has to tell, if there is anything."""


class Intake:
    """All topics that the rules read."""

    def __init__(self, core: Core) -> None:
        self._core = core
        self._fields = [self._named_fields(index) for index in range(len(core.machine.channels))]

    def take(self, channel: int) -> Take:
        """The fastest way from a message on a channel into the core."""
        core = self._core
        described = core.machine.channels[channel]
        paths = [slot.path for slot in self._on(channel, core.machine.slots)]
        if self._on(channel, core.machine.arrays) or not _are_plain(paths, described.message_type):
            return lambda at_ns, message: core.update(at_ns, self._values(channel, message))
        call = core.update_call(described.topic)
        read = _read_all(paths)

        def take(at_ns: int, message: Message) -> Told | None:
            return core.take() if call(at_ns, *read(message)) else None

        return take

    def begin(self, at_ns: int, first: Mapping[int, Message]) -> Told:
        """The first messages of several channels arrive together."""
        values: dict[str, Value] = {}
        for channel, message in first.items():
            values |= self._values(channel, message)
        return self._core.update(at_ns, values)

    def _values(self, channel: int, message: Message) -> dict[str, Value]:
        return {name: _value(message, path) for name, path in self._fields[channel].items()}

    def _named_fields(self, channel: int) -> dict[str, Path]:
        """The fields of a channel, as the core calls them; of an input of which only the age is
        read, the whole message.
        """
        machine = self._core.machine
        slots, arrays = field_names(machine)
        named: list[tuple[frozenset[str], Slot | Array]]
        named = [*zip(slots, machine.slots, strict=True), *zip(arrays, machine.arrays, strict=True)]
        fields: dict[str, Path] = {
            max(names, key=len): field.path
            for names, field in named
            if machine.inputs[field.input].channel == channel
        }
        ages = arrival_names(machine).items()
        return fields | {name: () for name, arriving in ages if arriving == channel}

    def _on(self, channel: int, fields: Sequence[Slot] | Sequence[Array]) -> list[Slot | Array]:
        inputs = self._core.machine.inputs
        return [field for field in fields if inputs[field.input].channel == channel]


def _are_plain(paths: Sequence[Path], message_type: str) -> bool:
    """Say whether all fields are numbers or flags that stand for themselves."""
    empty = messages.new_message(message_type)
    return all(_is_plain(empty, path) for path in paths)


def _is_plain(empty: Message, path: Path) -> bool:
    """Of elements, only those of arrays of numbers."""
    *parents, last = path
    if not all(isinstance(part, str) for part in parents):
        return False
    if not isinstance(last, str):
        return isinstance(_value(empty, tuple(parents)), np.ndarray)
    return isinstance(_value(empty, path), int | float)


def _read_all(paths: Sequence[Path]) -> Callable[[Message], Sequence[float]]:
    """Like `attrgetter`, but always of numbers, and always several."""
    if any(not isinstance(path[-1], str) for path in paths):
        return lambda message: [float(_field(message, path)) for path in paths]
    attributes = [".".join(map(str, path)) for path in paths]
    if len(paths) > 1:
        read = attrgetter(*attributes)
        return lambda message: list(map(float, read(message)))
    read_one: Callable[[Message], Any] | None = attrgetter(*attributes) if attributes else None
    return lambda message: () if read_one is None else (float(read_one(message)),)


def _field(message: Message, path: Path) -> Any:
    """The value to which a path leads; NaN for an element that is not there."""
    value = message
    for step, part in enumerate(path):
        if isinstance(part, str):
            value = getattr(value, part)
            continue
        if isinstance(part, Each):
            return [_field(each, path[step + 1 :]) for each in value]
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
    """A field; NaN for an element that is not there, seconds for an instant, 1 for a message."""
    if not path:
        return 1.0
    value = _field(message, path)
    if isinstance(value, messages.Time):
        return float(value.sec) + value.nanosec * 1e-9
    found: Value = value
    return found
