"""Values by the names of fields, in the user's form and in the form of engines."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TypeAlias, cast

import numpy as np

from rossmarie.engines.queries import MachineQueries
from rossmarie.engines.scans import values_of_scan
from rossmarie.ir import (
    AXES,
    EACH,
    POINTS,
    ChannelValues,
    FieldKind,
    Machine,
    arrival_names,
    columns_of,
    field_names,
    list_names,
    near_name,
    path_names,
    point_columns,
    scan_names,
)
from rossmarie.ir.carried import holds_flags
from rossmarie.ir.clouds import Cloud, UnreadableCloudError, columns, is_cloud, leave_out
from rossmarie.ir.scans import LaserScan, is_scan
from rossmarie.ir.skills import SkillMessage

Value: TypeAlias = (
    float | bool | str | Sequence[float] | Sequence[str] | Sequence[object] | Cloud | LaserScan
    | SkillMessage | None
)  # fmt: skip
"""The content of a message field: a number, a flag, a string, the elements of an array, or the
elements of a list of messages, as dictionaries or objects. None is an unknown list. The points of a
cloud may also be given as their message, the values of a scan as the scan, and the answers of
skills as the message about the running skills.
"""

_FRAME = ("header", "frame_id")
"""The field with the frame of a message."""
_WANTED = {FieldKind.REAL: "a number", FieldKind.FLAG: "a flag", FieldKind.TEXT: "a string"}
_NUMBERS = (int, float, np.integer, np.floating, np.bool_)


class NamedValues:
    """The names of one machine. Names of fields are names of inputs: `speed`, `orientation.x`. An
    input whose rules read only its age has its own name. A query about skills is named by its
    words, `doing Push`, for all inputs with this query.
    """

    def __init__(self, machine: Machine) -> None:
        self._machine = machine
        self.slots, self.arrays = (_by_name(names) for names in field_names(machine))
        self.queries = MachineQueries(machine)
        self.lists = _by_name(list_names(machine))
        self.arrivals = arrival_names(machine)
        self._clouds = point_columns(machine)
        self._scans = scan_names(machine)

    def messages(self, values: Mapping[str, Value]) -> dict[int, ChannelValues]:
        """The messages, by channel: one on each channel with a named field.

        Raises `KeyError` for a name that no rule reads, `TypeError` for a value whose type differs
        from the field's, and `OverflowError` for an integer beyond all floats.
        """
        slots: dict[int, dict[int, float]] = {}
        arrays: dict[int, dict[int, Sequence[float]]] = {}
        for name, value in values.items():
            if name in self._scans and is_scan(value):
                channel, content = values_of_scan(self._machine, self._scans[name], value)
                slots.setdefault(channel, {}).update(content.slots)
                arrays.setdefault(channel, {}).update(content.arrays)
            elif answers := self._answers(name, value):
                channel = self._channel(self._machine.slots[next(iter(answers))].input)
                slots.setdefault(channel, {}).update(answers)
            elif name in self.slots:
                index = self.slots[name]
                channel = self._channel(self._machine.slots[index].input)
                slots.setdefault(channel, {})[index] = self._number(index, value)
            elif name in self.lists and (name not in self.arrays or not _is_column(value)):
                index = self.lists[name]
                channel = self._channel(self._machine.lists[index].input)
                arrays.setdefault(channel, {}).update(self._columns(name, index, value))
                for slot, number in self._frame(self._machine.lists[index].input, value).items():
                    slots.setdefault(channel, {}).setdefault(slot, number)
            elif name in self.arrays:
                index = self.arrays[name]
                channel = self._channel(self._machine.arrays[index].input)
                arrays.setdefault(channel, {})[index] = self._elements(name, index, value)
            elif name in self.arrivals:
                slots.setdefault(self.arrivals[name], {})
            else:
                raise KeyError(self.unknown(name))
        for found in arrays.values():
            for cloud in self._clouds:
                leave_out(cloud, found)
        return {
            channel: ChannelValues(slots.get(channel, {}), arrays.get(channel, {}))
            for channel in slots.keys() | arrays.keys()
        }

    def _answers(self, name: str, value: Value) -> dict[int, float]:
        """Answers of skills, by slot, given for a whole topic or for one query."""
        if self.queries.is_context(name, value):
            return self.queries.answers(name, cast("SkillMessage", value))
        asked = self.queries.named.get(name, ())
        return {index: self._number(index, value) for index in asked}

    def shortest(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """The shortest name of each slot, and of each array."""
        slots, arrays = (
            tuple(min(sorted(names), key=len, default="") for names in fields)
            for fields in field_names(self._machine)
        )
        return slots, arrays

    def scalars(self, channel: int) -> tuple[str, ...]:
        """The shortest names of the slots of a channel, in index order."""
        names, _ = self.shortest()
        return tuple(
            names[index]
            for index, slot in enumerate(self._machine.slots)
            if self._channel(slot.input) == channel
        )

    def unknown(self, name: str) -> str:
        """The error text for a name that no rule reads."""
        near = near_name(
            name,
            (
                *self.queries.named,
                *self.slots,
                *self.arrays,
                *self.lists,
                *self.arrivals,
                *self._scans,
            ),
        )
        return f"no rule reads `{name}`" + (f"; did you mean `{near}`?" if near else "")

    def _channel(self, used: int) -> int:
        return self._machine.inputs[used].channel

    def _number(self, slot: int, value: Value) -> float:
        """The number of a value. A string is its index among the strings of the machine, or -1."""
        return self._number_of(self._machine.slots[slot].kind, value)

    def _number_of(self, kind: FieldKind, value: object) -> float:
        if isinstance(value, str) and kind is FieldKind.TEXT:
            texts = self._machine.texts
            return float(texts.index(value)) if value in texts else -1.0
        if isinstance(value, _NUMBERS) and kind is not FieldKind.TEXT:
            number = float(value)
            return _flag(number) if kind is FieldKind.FLAG else number
        raise TypeError(f"expected {_WANTED[kind]}, not {value!r}")

    def _elements(self, name: str, array: int, value: Value) -> list[float]:
        if self._machine.arrays[array].kind is not FieldKind.TEXT:
            return _numbers(name, value)
        if isinstance(value, str) or not isinstance(value, Sequence):
            raise TypeError(f"`{name}` takes the strings of all elements, not {value!r}")
        return [self._number_of(FieldKind.TEXT, each) for each in value]

    def _columns(self, name: str, its_list: int, value: Value) -> dict[int, list[float]]:
        """The columns of a list of dictionaries or objects, or of a cloud; empty if the list is
        unknown.
        """
        if value is None:
            return {}
        is_of_points = self._is_of_points(its_list)
        if is_of_points and is_cloud(value):
            return self._points(its_list, value)
        if isinstance(value, str) or not isinstance(value, Sequence):
            raise TypeError(f"`{name}` takes a list of messages, not {value!r}")
        if is_of_points:
            value = [point for point in value if not any(_is_nan(point, axis) for axis in AXES)]
        found = {}
        for column in columns_of(self._machine, its_list):
            array = self._machine.arrays[column]
            kind = FieldKind.FLAG if holds_flags(array) else array.kind
            words = path_names(array.path[array.path.index(EACH) + 1 :])
            fields = [_field(name, element, words) for element in value]
            if is_of_points and None in fields:
                return {}  # all points of a cloud have the same fields
            found[column] = [
                math.nan if each is None else self._number_of(kind, each) for each in fields
            ]
        return found

    def _frame(self, used: int, value: Value) -> dict[int, float]:
        """The frame of a cloud that is given as its message, by slot."""
        frame = getattr(getattr(value, "header", None), "frame_id", None)
        if not isinstance(frame, str):
            return {}
        return {
            index: self._number(index, frame)
            for index, slot in enumerate(self._machine.slots)
            if slot.input == used and slot.path == _FRAME
        }

    def _points(self, its_list: int, cloud: Cloud) -> dict[int, list[float]]:
        """The columns of the points of a cloud; empty if they are unknown (S56)."""
        found = columns_of(self._machine, its_list)
        names = [str(self._machine.arrays[column].path[-1]) for column in found]
        try:
            read = columns(cloud, names, self._machine.lists[its_list].most)
        except UnreadableCloudError:
            return {}
        return {column: each.tolist() for column, each in zip(found, read, strict=True)}

    def _is_of_points(self, its_list: int) -> bool:
        return POINTS in self._machine.lists[its_list].path


def _is_nan(point: object, axis: str) -> bool:
    found = point.get(axis) if isinstance(point, Mapping) else getattr(point, axis, None)
    return isinstance(found, float) and math.isnan(found)


def _field(name: str, element: object, words: Sequence[str]) -> object:
    """A field of an element of a list; None if it is missing in a dictionary."""
    if isinstance(element, Mapping) and ".".join(words) in element:
        return element[".".join(words)]
    for word in words:
        if isinstance(element, Mapping):
            element = element.get(word)
        elif hasattr(element, word):
            element = getattr(element, word)
        elif element is not None:
            raise TypeError(f"an element of `{name}` has no field `{'.'.join(words)}`: {element!r}")
    return element


def _is_column(value: Value) -> bool:
    """Say whether a value is a column, with one field of each element, instead of the elements
    themselves.
    """
    if isinstance(value, str) or not isinstance(value, Sequence | np.ndarray):
        return False
    return all(isinstance(each, (str, *_NUMBERS)) for each in value)


def _by_name(names: Sequence[frozenset[str]]) -> dict[str, int]:
    return {name: index for index, known in enumerate(names) for name in known}


def _flag(number: float) -> float:
    return float(number != 0.0) if math.isfinite(number) else math.nan


def _numbers(name: str, value: Value) -> list[float]:
    elements = np.asarray(value)
    if elements.ndim != 1 or elements.dtype.kind not in "buif":
        raise TypeError(f"`{name}` takes an array of numbers, not {value!r}")
    found: list[float] = elements.astype(np.float64).tolist()
    return found
