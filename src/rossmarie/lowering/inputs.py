"""The inputs of a machine: the channels, inputs, slots, arrays and texts that rules use.

Each entry is created on demand, so a machine contains only entries that rules need.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rossmarie import ir
from rossmarie.check.model import CheckedInput, Gaps
from rossmarie.check.names.parts import MessagePart
from rossmarie.types import (
    Array,
    Boolean,
    Box,
    Entry,
    Interval,
    List,
    Message,
    Motion,
    Quantity,
    Quaternion,
    Region,
    Text,
    Type,
    Unknown,
    Unsupported,
    Vector,
)
from rossmarie.units import DIMENSIONLESS, Unit


@dataclass(frozen=True, eq=False)
class InputPart:
    """A part of the message that an input reads."""

    input: CheckedInput
    part: MessagePart

    @property
    def path(self) -> ir.Path:
        """The path from the message to the part."""
        return self.part.path

    def field(self, name: str, type_: Type) -> InputPart:
        """A field of this part, with its type."""
        return InputPart(self.input, self.part.field(name, type_))

    def sector(self, sector: ir.Sector) -> InputPart:
        """A sector of this part, which is the `ranges` of a scan."""
        return InputPart(self.input, self.part.sector(sector))

    def element(self, index: int | str, owner: Type) -> InputPart:
        """An element of this part. `owner` is the type of this part."""
        return InputPart(self.input, self.part.element(index, owner))

    def each(self) -> InputPart:
        """Any element of this part. This part is a list."""
        return InputPart(self.input, MessagePart((*self.part.path, ir.EACH)))

    @property
    def list_path(self) -> ir.Path | None:
        """The path of the list that contains this part; None if no list contains it."""
        path = self.part.path
        return path[: path.index(ir.EACH)] if ir.EACH in path else None


@dataclass
class InputLowering:
    """Collects the entries one by one. Every method returns the index of the requested entry.
    `gaps` are the times between messages, by topic.
    """

    gaps: Mapping[str, Gaps]
    channels: list[ir.Channel] = field(default_factory=list)
    inputs: list[ir.Input] = field(default_factory=list)
    slots: list[ir.Slot] = field(default_factory=list)
    arrays: list[ir.Array] = field(default_factory=list)
    lists: list[ir.List] = field(default_factory=list)
    texts: list[str] = field(default_factory=list)
    _by_topic: dict[str, int] = field(default_factory=dict)
    _by_name: dict[str, int] = field(default_factory=dict)
    _slots_by_place: dict[tuple[int, ir.Path], int] = field(default_factory=dict)
    _arrays_by_place: dict[tuple[int, ir.Path], int] = field(default_factory=dict)

    def channel(self, used: CheckedInput) -> int:
        """The channel of an input."""
        index = self._by_topic.setdefault(used.topic, len(self.channels))
        if index == len(self.channels):
            gaps = self.gaps.get(used.topic)
            self.channels.append(ir.Channel(used.topic, used.message_type, gaps, used.edge))
        return index

    def input(self, used: CheckedInput) -> int:
        """A named input."""
        name = used.declaration.name
        index = self._by_name.setdefault(name.text, len(self.inputs))
        if index == len(self.inputs):
            channel = self.channel(used)
            self.inputs.append(ir.Input(name.text, channel, used.timeout_ns, name.span))
        return index

    def slot(self, place: InputPart, type_: Type) -> int:
        """The slot of one number, flag or text of a message."""
        used = self.input(place.input)
        index = self._slots_by_place.setdefault((used, place.path), len(self.slots))
        if index == len(self.slots):
            unit = _unit(type_)
            kind, shown = _kind(type_), _symbol(unit)
            limits = _limits(type_) if kind is ir.FieldKind.REAL else None
            slot = ir.Slot(used, place.path, kind, unit.scale, unit.offset, shown, limits)
            self.slots.append(slot)
        return index

    def array(self, place: InputPart, type_: Array) -> int:
        """The array of all numbers or flags of an array of a message."""
        used = self.input(place.input)
        index = self._arrays_by_place.setdefault((used, place.path), len(self.arrays))
        if index == len(self.arrays):
            unit = _unit(type_.element)
            shown, limits = _symbol(unit), _limits(type_.element)
            array = ir.Array(used, place.path, unit.scale, unit.offset, shown, limits)
            self.arrays.append(array)
        return index

    def column(self, place: InputPart, type_: Type) -> int:
        """The array of one number, flag or text of each element of a list."""
        used = self.input(place.input)
        index = self._arrays_by_place.setdefault((used, place.path), len(self.arrays))
        if index == len(self.arrays):
            unit, kind = _unit(type_), _kind(type_)
            shown, limits = _symbol(unit), _limits(type_)
            stored = ir.FieldKind.TEXT if kind is ir.FieldKind.TEXT else ir.FieldKind.REAL
            its_list = self._list(place)
            column = ir.Array(
                used, place.path, unit.scale, unit.offset, shown, limits, stored, its_list
            )
            self.arrays.append(column)
        return index

    def _list(self, place: InputPart) -> int:
        path, most = place.list_path, place.input.most
        assert path is not None, "only elements of lists are columns"
        assert most is not None, "checked: lists that are read have a bound"
        its_list = ir.List(self.input(place.input), path, most)
        if its_list not in self.lists:
            self.lists.append(its_list)
        return self.lists.index(its_list)

    def text(self, text: str) -> int:
        """The index of a text that rules compare with."""
        if text not in self.texts:
            self.texts.append(text)
        return self.texts.index(text)


def _kind(type_: Type) -> ir.FieldKind:
    match type_:
        case Boolean():
            return ir.FieldKind.FLAG
        case Text():
            return ir.FieldKind.TEXT
        case (
            Quantity() | Vector() | Quaternion() | Array() | List() | Interval() | Box() | Message()
            | Region() | Motion() | Entry() | Unsupported() | Unknown()
        ):  # fmt: skip
            return ir.FieldKind.REAL


def _unit(type_: Type) -> Unit:
    """The unit in which a field arrives; a plain number if it is unknown."""
    unit = type_.unit if isinstance(type_, Quantity) else None
    return DIMENSIONLESS if unit is None else unit


def _limits(type_: Type) -> tuple[float, float] | None:
    """The limits of an element or a number. An array holds its flags as 0 and 1."""
    match type_:
        case Boolean():
            return ir.FLAG_LIMITS
        case Quantity(limits=limits):
            return limits
        case (
            Text() | Vector() | Quaternion() | Array() | List() | Interval() | Box() | Message()
            | Region() | Motion() | Entry() | Unsupported() | Unknown()
        ):  # fmt: skip
            return None


def _symbol(unit: Unit) -> str:
    return "" if unit == DIMENSIONLESS else unit.symbol
