"""The columns of a CSV file that hold the fields, by their names."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import SequenceMatcher

from rossmarie.ir import EACH, Array, Listed, Machine, Slot
from rossmarie.ir.beams import is_of_scan
from rossmarie.recordings.clouds import is_of_points
from rossmarie.recordings.matching import Match
from rossmarie.recordings.skills import query_of

_COMPARED = 200
_EACH = "*"
"""The sign in names for the number of an element of a list; columns have numbers there."""
_ALIKE = 0.7
"""The likeness of two names, from 0 to 1, from which one may be a slip of the other."""


@dataclass(frozen=True)
class Columns:
    """The column of each slot, and those of the elements of each array, by index. `listed` has the
    columns of a whole array for each slot that is an element of it by a declared name.

    `missing` are the fields without a column. Where `arrival` is filled, a message came, whatever
    else is known of it.
    """

    slots: Mapping[int, int]
    listed: Mapping[int, tuple[int, ...]]
    arrays: Mapping[int, tuple[int, ...]]
    missing: tuple[Slot | Array, ...]
    arrival: int | None

    def used(self) -> tuple[int, ...]:
        """All columns that are read, each once."""
        wholes = (*self.listed.values(), *self.arrays.values())
        elements = (column for columns in wholes for column in columns)
        arrival = () if self.arrival is None else (self.arrival,)
        return tuple(dict.fromkeys((*self.slots.values(), *elements, *arrival)))


def column_keys(names: Sequence[str]) -> Mapping[str, int]:
    """The position of each column but the first; indices in names are written `[0]` or `.0`."""
    return {_key(name): i for i, name in enumerate(names) if i > 0}


def duplicate_column(names: Sequence[str]) -> int | None:
    """The position of the first column whose name, if it has one, stands there before."""
    seen: set[str] = set()
    for position, name in enumerate(names[1:], start=1):
        if name and _key(name) in seen:
            return position
        seen.add(_key(name))
    return None


def expected_column(match: Match, field: Slot | Array, machine: Machine) -> str:
    """The shortest name that a column of a field may have."""
    *_, name = _names(match, field, machine)
    if isinstance(field, Array) and field.list is not None:
        return name.replace(f".{_EACH}", "[0]")
    return f"{name}[0]" if isinstance(field, Array) else name


def similar_column(
    match: Match, fields: Sequence[Slot | Array], machine: Machine, unread: Sequence[str]
) -> tuple[str, str] | None:
    """The one of some columns that is most likely meant for one of some fields, and the name that
    it should have; None if none is likely. Upper and lower case make no difference.
    """
    alike = [
        (SequenceMatcher(None, name.lower(), column.lower()).ratio(), field, column)
        for field in fields
        for name in _names(match, field, machine)
        for column in unread[:_COMPARED]
    ]
    likeness, field, column = max(alike, key=lambda found: found[0], default=(0.0, None, ""))
    if field is None or likeness < _ALIKE:
        return None
    return column, expected_column(match, field, machine)


def _key(name: str) -> str:
    return re.sub(r"\[(\d+)\]", r".\1", name)


def match_columns(match: Match, keys: Mapping[str, int], machine: Machine) -> Columns:
    """The columns that hold what a channel reads."""
    slots: dict[int, int] = {}
    listed: dict[int, tuple[int, ...]] = {}
    arrays: dict[int, tuple[int, ...]] = {}
    missing: list[Slot | Array] = []
    for index, slot in match.slots.items():
        found = [keys[name] for name in _names(match, slot, machine) if name in keys]
        if found:
            slots[index] = found[0]
        elif whole := _whole(match, slot, keys, machine):
            listed[index] = whole
        else:
            missing.append(slot)
    for index, array in match.arrays.items():
        if is_of_points(array) or is_of_scan(array):
            missing.append(array)
            continue
        elements = [_elements(name, keys) for name in _names(match, array, machine)]
        arrays[index] = next((columns for columns in elements if columns), ())
        if not arrays[index]:
            missing.append(array)
    taken = Columns(slots, listed, arrays, (), None).used()
    arrival = next(
        (keys[name] for name in _arrivals(match, machine, bool(taken)) if name in keys), None
    )
    is_free = arrival not in taken
    return Columns(slots, listed, arrays, tuple(missing), arrival if is_free else None)


def _arrivals(match: Match, machine: Machine, has_fields: bool) -> Iterator[str]:
    """The names that the column may have that says that a message came. A column that is called
    like an input is meant for what that reads, if it reads anything.
    """
    reads_nothing = not match.slots and not match.arrays
    if has_fields or reads_nothing:
        yield match.topic
    if reads_nothing:
        yield from (machine.inputs[reader].name for reader in match.inputs)


def _whole(match: Match, slot: Slot, keys: Mapping[str, int], machine: Machine) -> tuple[int, ...]:
    """The columns of the array in which a slot is an element by a declared name."""
    if not (slot.path and isinstance(slot.path[-1], Listed)):
        return ()
    whole = replace(slot, path=slot.path[:-1])
    elements = (_elements(name, keys) for name in _names(match, whole, machine))
    return next((columns for columns in elements if columns), ())


def _elements(name: str, keys: Mapping[str, int]) -> tuple[int, ...]:
    """The columns of the elements of an array, or of a field of all elements of a list, from 0 to
    the first that has none.
    """
    place = f".{_EACH}."
    before, place, behind = name.partition(place) if place in name else (name, ".", "")
    found: list[int] = []
    while (key := f"{before}.{len(found)}{'.' if behind else ''}{behind}") in keys:
        found.append(keys[key])
    return tuple(found)


def _names(match: Match, field: Slot | Array, machine: Machine) -> Iterator[str]:
    """The names that the column of a field may have, the most explicit first.

    How much of the path an input selects is not known here: behind the name of an input may stand
    any end of the path by which no other field of this input ends.
    """
    path = _texts(field)
    yield ".".join([match.topic, *path])
    if path == ("data",):
        yield match.topic
    if isinstance(field, Slot) and query_of(field) is not None:
        # All inputs that read the context ask the same, and one of them is the compiler's own.
        readers = (machine.inputs[reader].name for reader in match.inputs)
        yield from sorted((".".join([name, *path]) for name in readers), key=len, reverse=True)
        return
    last = path.index(_EACH) if _EACH in path else len(path)
    siblings = {_texts(other) for other in match.fields_of(field.input)} - {path}
    siblings = {other for other in siblings if other[:-1] != path}
    for start in range(last + 1):
        end = path[start:]
        if not any(other[len(other) - len(end) :] == end for other in siblings):
            yield ".".join([machine.inputs[field.input].name, *end])


def _texts(field: Slot | Array) -> tuple[str, ...]:
    return tuple(_EACH if part == EACH else str(part) for part in field.path)
