"""Declarations of the numbers in observations and actions, checked against a rules file.

    observe={"speed": 0, "force.z": (8, "N"), "joints.position": slice(1, 8), "battery": None}
    act={"/cmd_vel.linear.x": 0, "angular.z": (1, "deg/s")}

An index gives a number, a slice gives an array. A unit follows if it differs from the unit of the
message. None is for a field that the arrays do not contain. For an array with named elements, give
a slice, or declare each element: `efforts.elbow`. A query about skills has its words as name,
`doing Push(Object: Fragile)`, and is 1 or 0.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias, TypeVar

from rossmarie.engines import NamedValues
from rossmarie.ir import (
    CommandPart,
    FieldKind,
    FieldPart,
    Listed,
    Machine,
    Publication,
    Wiring,
    columns_of,
    near_name,
    point_columns,
)
from rossmarie.ir.reactions import CommandField, Limit, Publish
from rossmarie.units import DIMENSIONLESS, Unit, UnknownUnitError, parse_unit

Index: TypeAlias = int | slice
Place: TypeAlias = Index | tuple[Index, str] | None
"""The place of a field in a flat array, and its unit."""

Declared: TypeAlias = Mapping[str, Place]


_Key = TypeVar("_Key")


class MappingError(ValueError):
    """The declarations do not fit the rules, or the arrays do not fit the declarations."""


@dataclass(frozen=True)
class _Entry:
    """A declared field. `part` has everything except the indexes. A `listed` entry is an element of
    the declared array.
    """

    name: str
    index: Index | None
    part: FieldPart
    is_array: bool = False
    listed: Listed | None = None

    def placed(self, what: str, size: int) -> FieldPart:
        """The part in an array of a given size."""
        if self.index is None:
            return self.part
        if isinstance(self.index, int):
            if not -size <= self.index < size:
                raise MappingError(f"`{self.name}` is {what}[{self.index}], of {size} numbers")
            return replace(self.part, first=self.index % size, count=1)
        stop = self.index.stop
        places = range(*self.index.indices(size))
        if not places or (stop is not None and abs(stop) > size):
            shown = f"{self.index.start or 0}:{'' if stop is None else stop}"
            raise MappingError(f"`{self.name}` is {what}[{shown}], of {size} numbers")
        if self.listed is not None:
            return self._element(self.listed, places)
        if not self.is_array and len(places) != 1:
            raise MappingError(f"`{self.name}` is one number, not {len(places)}")
        return replace(self.part, first=places[0], count=len(places), step=places.step)

    def _element(self, listed: Listed, places: range) -> FieldPart:
        if len(places) != listed.count:
            raise MappingError(f"`{self.name}` has {listed.count} names, not {len(places)}")
        return replace(self.part, first=places[listed.place], count=1)


class ArrayMapping:
    """All declarations for one machine. Raises `MappingError` for declarations that do not fit its
    rules.
    """

    def __init__(self, machine: Machine, observe: Declared, act: Declared) -> None:
        self._machine = machine
        self._values = NamedValues(machine)
        self._listed = _listed_slots(machine)
        self._slots: dict[int, _Entry] = {}
        self._arrays: dict[int, _Entry] = {}
        self._arrivals: dict[int, bool] = {}
        self._fields: dict[tuple[int, int], _Entry] = {}
        for name, place in observe.items():
            self._observe(name, place)
        self._require_all()
        known = _command_names(machine)
        for name, place in act.items():
            self._act(known, name, place)
        self._require_limited()

    def wiring(self, observed: int, acted: int | None) -> Wiring:
        """The declarations for arrays of these sizes; None means that there was no action yet.
        Raises `MappingError` if the arrays are too small.
        """
        slots = [self._slots[index] for index in range(len(self._machine.slots))]
        arrays = [self._arrays[index] for index in range(len(self._machine.arrays))]
        self._require_lists(observed)
        commands = tuple(
            CommandPart(command, field, part)
            for (command, field), entry in sorted(self._fields.items())
            if acted is not None and (part := entry.placed("action", acted)).count
        )
        return Wiring(
            observed=observed,
            acted=acted or 0,
            slots=tuple(entry.placed("observation", observed) for entry in slots),
            arrays=tuple(entry.placed("observation", observed) for entry in arrays),
            arriving=self._arriving(),
            commands=commands,
            publications=tuple(self._publications(commands)),
            clouds=point_columns(self._machine),
        )

    def name(self, part: CommandPart) -> str:
        """The name under which a field of a command was declared."""
        return self._fields[part.command, part.field].name

    # --- observations ------------------------------------------------------------------------

    def _observe(self, name: str, place: Place) -> None:
        values, machine = self._values, self._machine
        index, unit = place if isinstance(place, tuple) else (place, None)
        whole = {} if isinstance(index, int) else self._listed.get(name, {})
        for slot, listed in whole.items():
            part = self._slot_part(slot, name, unit)
            _enter(self._slots, slot, _Entry(name, index, part, listed=listed))
        asked = values.queries.named.get(name, ())
        for slot in asked:
            _enter(self._slots, slot, _Entry(name, index, self._slot_part(slot, name, unit)))
        if name in values.slots and not whole:
            slot = values.slots[name]
            if machine.slots[slot].kind is FieldKind.TEXT and place is not None:
                raise MappingError(f"`{name}` is a string, which an array cannot contain")
            _enter(self._slots, slot, _Entry(name, index, self._slot_part(slot, name, unit)))
        elif name in values.arrays:
            array = machine.arrays[values.arrays[name]]
            if array.kind is FieldKind.TEXT and place is not None:
                raise MappingError(f"`{name}` has strings, which an array cannot contain")
            if isinstance(index, int):
                raise MappingError(f"`{name}` is an array: give a slice, such as slice(0, 7)")
            part = FieldPart()
            if unit is not None:
                part = _converted(name, unit, array.unit, array.scale, array.offset)
            _enter(self._arrays, values.arrays[name], _Entry(name, index, part, is_array=True))
        elif name in values.arrivals:
            self._arrivals[values.arrivals[name]] = place is not None
        elif not whole and not asked:
            raise MappingError(values.unknown(name))

    def _slot_part(self, index: int, name: str, unit: str | None) -> FieldPart:
        slot = self._machine.slots[index]
        if unit is not None:
            return _converted(name, unit, slot.unit, slot.scale, slot.offset)
        return FieldPart(is_flag=slot.kind is FieldKind.FLAG)

    def _require_all(self) -> None:
        """Raise `MappingError` unless every field that rules read is declared."""
        slots, arrays = self._values.shortest()
        words = self._values.queries.words
        missing = [
            words(index) or name for index, name in enumerate(slots) if index not in self._slots
        ]
        missing += [name for index, name in enumerate(arrays) if index not in self._arrays]
        arrivals = self._values.arrivals.items()
        missing += [name for name, channel in arrivals if channel not in self._arrivals]
        if missing:
            listed = ", ".join(f"`{name}`" for name in dict.fromkeys(missing))
            raise MappingError(
                f"rules read {listed}, which `observe` lacks (None: it is never observed)"
            )

    def _require_lists(self, observed: int) -> None:
        """Raise `MappingError` unless all fields of an observed list are declared, with equal
        lengths.
        """
        arriving = self._arriving()
        for number, its_list in enumerate(self._machine.lists):
            if self._machine.inputs[its_list.input].channel not in arriving:
                continue
            entries = [self._arrays[column] for column in columns_of(self._machine, number)]
            parts = [entry.placed("observation", observed) for entry in entries]
            is_whole = all(entry.index is not None for entry in entries)
            if not is_whole or len({part.count for part in parts}) > 1:
                listed = ", ".join(f"`{entry.name}`" for entry in entries)
                raise MappingError(
                    f"{listed} belong to one list, so they need equally many numbers"
                )

    def _arriving(self) -> frozenset[int]:
        inputs = self._machine.inputs
        channels = {channel for channel, arrives in self._arrivals.items() if arrives}
        for fields, entries in (
            ([slot.input for slot in self._machine.slots], self._slots),
            ([array.input for array in self._machine.arrays], self._arrays),
        ):
            channels |= {
                inputs[used].channel
                for index, used in enumerate(fields)
                if entries[index].index is not None
            }
        return frozenset(channels)

    # --- actions -----------------------------------------------------------------------------

    def _act(self, known: Mapping[str, tuple[int, int]], name: str, place: Place) -> None:
        if name not in known:
            near = near_name(name, known)
            meant = f"; did you mean `{near}`?" if near else ""
            raise MappingError(f"no rule bounds `{name}`{meant}")
        command, number = known[name]
        field = self._machine.reactions.commands[command].fields[number]
        index, unit = place if isinstance(place, tuple) else (place, None)
        part = FieldPart() if unit is None else _converted(name, unit, field.unit)
        _enter(self._fields, known[name], _Entry(name, index, part, field.is_array))

    def _require_limited(self) -> None:
        """Raise `MappingError` unless each separately limited field, and at least one field of each
        command, is declared.
        """
        reactions = self._machine.reactions
        for index, command in enumerate(reactions.commands):
            limited = {
                bound.field
                for task in reactions.tasks
                if isinstance(task.effect, Limit) and task.effect.topic == index
                for bound in task.effect.bounds
                if len(task.effect.bounds) < len(command.fields)
            }
            for field in sorted(limited):
                if (index, field) not in self._fields:
                    raise MappingError(_lacking(_full_name(command.topic, command.fields[field])))
            if not any(known == index for known, _ in self._fields):
                raise MappingError(_lacking(command.topic))

    def _publications(self, commands: Sequence[CommandPart]) -> Iterator[Publication]:
        reactions = self._machine.reactions
        for index, task in enumerate(reactions.tasks):
            effect = task.effect
            if isinstance(effect, Publish) and effect.command is not None:
                parts = [each for each in commands if each.command == effect.command]
                numbers = [number for each in parts for number in self._published(effect, each)]
                lasts = effect.period_ns is not None
                yield Publication(index, effect.command, lasts, tuple(numbers))

    def _published(self, effect: Publish, part: CommandPart) -> Sequence[float]:
        """The numbers that a rule publishes in place of a part; 0 for a field that the rule does
        not set.
        """
        path = self._machine.reactions.commands[part.command].fields[part.field].path
        values = (each.value for each in effect.assignments if each.path == path)
        value = next(values, (0.0,) * part.part.count)
        numbers = [float(each) for each in (value if isinstance(value, tuple) else (value,))]
        if len(numbers) != part.part.count:
            raise MappingError(
                f"a rule publishes {len(numbers)} numbers as `{self.name(part)}`, "
                f"actions have {part.part.count}"
            )
        return numbers


def _listed_slots(machine: Machine) -> dict[str, dict[int, Listed]]:
    """The slots of named elements, by the names of their arrays."""
    found: dict[str, dict[int, Listed]] = {}
    for index, slot in enumerate(machine.slots):
        *words, last = slot.path or ("",)
        if isinstance(last, Listed):
            used = machine.inputs[slot.input].name
            endings = [words[start:] for start in range(len(words) + 1)]
            for ending in endings:
                found.setdefault(".".join(map(str, (used, *ending))), {})[index] = last
    return found


def _enter(entries: dict[_Key, _Entry], key: _Key, entry: _Entry) -> None:
    if key in entries:
        raise MappingError(f"`{entries[key].name}` and `{entry.name}` are the same field")
    entries[key] = entry


def _lacking(name: str) -> str:
    return f"rules bound `{name}`, which `act` lacks (None: actions have no such number)"


def _full_name(topic: str, field: CommandField) -> str:
    return ".".join([topic, *map(str, field.path)])


def _command_names(machine: Machine) -> dict[str, tuple[int, int]]:
    """The names of all fields of commands: with the topic, or by any unique end of the path."""
    found: list[tuple[str, tuple[int, int]]] = []
    for number, command in enumerate(machine.reactions.commands):
        for index, field in enumerate(command.fields):
            words = [command.topic, *map(str, field.path)]
            endings = {".".join(words[start:]) for start in range(len(words))}
            whole = {command.topic} if len(command.fields) == 1 else set()
            found += [(name, (number, index)) for name in endings | whole]
    uses = Counter(name for name, _ in found)
    return {name: place for name, place in found if uses[name] == 1}


def _converted(
    name: str, unit: str, of_message: str, scale: float | None = None, offset: float = 0.0
) -> FieldPart:
    """The part of a field whose unit differs from that of its message. The message's own scale and
    offset, or those of its unit, convert a number of a message to SI.
    """
    given, wanted = _parsed(name, unit), _parsed(name, of_message)
    if given.dimension != wanted.dimension:
        raise MappingError(f"`{name}` is in {wanted}, not in {given}")
    own_scale, own_offset = (wanted.scale, wanted.offset) if scale is None else (scale, offset)
    return FieldPart(scale=given.scale / own_scale, offset=(given.offset - own_offset) / own_scale)


def _parsed(name: str, unit: str) -> Unit:
    try:
        return parse_unit(unit) if unit else DIMENSIONLESS
    except UnknownUnitError as error:
        meant = f"; did you mean `{error.suggestions[0]}`?" if error.suggestions else ""
        raise MappingError(f"`{name}`: there is no unit `{unit}`{meant}") from error
