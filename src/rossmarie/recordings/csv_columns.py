"""Which column of a CSV file holds which field, by the names of the columns."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rossmarie.ir import Array, Machine, Slot
from rossmarie.recordings.matching import Match


@dataclass(frozen=True)
class Columns:
    """The column of each slot, and the columns of the elements of each array, by index.

    `missing` are the fields without a column.
    """

    slots: Mapping[int, int]
    arrays: Mapping[int, tuple[int, ...]]
    missing: tuple[Slot | Array, ...]

    def used(self) -> tuple[int, ...]:
        """All columns that are read, each once."""
        elements = (column for columns in self.arrays.values() for column in columns)
        return tuple(dict.fromkeys((*self.slots.values(), *elements)))


def column_keys(names: Sequence[str]) -> Mapping[str, int]:
    """The position of each column but the first; indices in names are written `[0]` or `.0`."""
    return {re.sub(r"\[(\d+)\]", r".\1", name): i for i, name in enumerate(names) if i > 0}


def match_columns(match: Match, keys: Mapping[str, int], machine: Machine) -> Columns:
    """The columns that hold what a channel reads."""
    slots: dict[int, int] = {}
    arrays: dict[int, tuple[int, ...]] = {}
    missing: list[Slot | Array] = []
    for index, slot in match.slots.items():
        found = [keys[name] for name in _names(match, slot, machine) if name in keys]
        if found:
            slots[index] = found[0]
        else:
            missing.append(slot)
    for index, array in match.arrays.items():
        elements = [_elements(name, keys) for name in _names(match, array, machine)]
        arrays[index] = next((columns for columns in elements if columns), ())
        if not arrays[index]:
            missing.append(array)
    return Columns(slots, arrays, tuple(missing))


def _elements(name: str, keys: Mapping[str, int]) -> tuple[int, ...]:
    """The columns of the elements of an array, from 0 to the first that has none."""
    found: list[int] = []
    while (key := f"{name}.{len(found)}") in keys:
        found.append(keys[key])
    return tuple(found)


def _names(match: Match, field: Slot | Array, machine: Machine) -> Iterator[str]:
    """What the column of a field may be called, the most explicit first.

    How much of the path an input selects is not known here: behind the name of an input may stand
    any end of the path by which no other field of this input ends.
    """
    path = _texts(field)
    yield ".".join([match.topic, *path])
    if path == ("data",):
        yield match.topic
    siblings = {_texts(other) for other in match.fields_of(field.input)} - {path}
    for start in range(len(path) + 1):
        end = path[start:]
        if not any(other[len(other) - len(end) :] == end for other in siblings):
            yield ".".join([machine.inputs[field.input].name, *end])


def _texts(field: Slot | Array) -> tuple[str, ...]:
    return tuple(str(part) for part in field.path)
