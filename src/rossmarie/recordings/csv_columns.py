"""The columns of a CSV file that contain the fields, by their names."""

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
"""The symbol for the index of a list's element in names; columns have a number there."""
_ALIKE = 0.7
"""The likeness of two names, from 0 to 1, from which one may be a misspelling of the other."""


@dataclass(frozen=True)
class SlotColumns:
    """The columns of slots, and of the elements of arrays, by index. For a slot that is an element
    with a declared name, `listed` contains the columns of the whole array.

    `missing` are the fields without a column. If the cell in `arrival` is filled, a message came,
    even if all values are unknown.
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
    """The position of each column except the first; indices in names are written `[0]` or `.0`."""
    return {_key(name): i for i, name in enumerate(names) if i > 0}


def duplicate_column(names: Sequence[str]) -> int | None:
    """The position of the first column with the name of an earlier column; empty names do not
    count.
    """
    seen: set[str] = set()
    for position, name in enumerate(names[1:], start=1):
        if name and _key(name) in seen:
            return position
        seen.add(_key(name))
    return None


def expected_column(match: Match, field: Slot | Array, machine: Machine) -> str:
    """The shortest possible name for a column of a field."""
    *_, name = _names(match, field, machine)
    if isinstance(field, Array) and field.list is not None:
        return name.replace(f".{_EACH}", "[0]")
    return f"{name}[0]" if isinstance(field, Array) else name


def similar_column(
    match: Match, fields: Sequence[Slot | Array], machine: Machine, unread: Sequence[str]
) -> tuple[str, str] | None:
    """The column that the user most likely meant for one of the fields, and its correct name; None
    if no column is likely. Upper and lower case are equal.
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


def match_columns(match: Match, keys: Mapping[str, int], machine: Machine) -> SlotColumns:
    """The columns with the fields that a channel reads."""
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
    taken = SlotColumns(slots, listed, arrays, (), None).used()
    arrival = next(
        (keys[name] for name in _arrivals(match, machine, bool(taken)) if name in keys), None
    )
    is_free = arrival not in taken
    return SlotColumns(slots, listed, arrays, tuple(missing), arrival if is_free else None)


def _arrivals(match: Match, machine: Machine, has_fields: bool) -> Iterator[str]:
    """The possible names of the column that shows that a message came. A column with the name of an
    input contains the input's value if the input reads a value.
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
    """The columns of the elements of an array, or of a field of all elements of a list, from index
    0 to the first missing index.
    """
    place = f".{_EACH}."
    before, place, behind = name.partition(place) if place in name else (name, ".", "")
    found: list[int] = []
    while (key := f"{before}.{len(found)}{'.' if behind else ''}{behind}") in keys:
        found.append(keys[key])
    return tuple(found)


def _names(match: Match, field: Slot | Array, machine: Machine) -> Iterator[str]:
    """The possible names for the column of a field, the most explicit first.

    The part of the path that an input selects is unknown here. So any end of the path may follow
    the name of the input, unless another field of this input has the same end.
    """
    path = _texts(field)
    yield ".".join([match.topic, *path])
    if path == ("data",):
        yield match.topic
    if isinstance(field, Slot) and query_of(field) is not None:
        # All inputs that read the context have the same fields, and one input belongs to the
        # compiler.
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
