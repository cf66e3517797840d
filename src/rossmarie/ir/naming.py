"""Names of the fields that a machine reads: the input, and as much of the path as is needed.

An input with one field has a name that is the input's name (`speed`). If an input has several
fields, the last words of the path tell them apart (`orientation.x`); any longer end of the path is
also a name. If an array is read as a whole, a single element (`ranges.5`) does not have the array's
names. A sector has the name of the input that reads the ranges (`ranges[-30 deg .. 30 deg]`).
"""

from __future__ import annotations

import difflib
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from rossmarie.ir.beams import scan_path
from rossmarie.ir.model import Array, List, Machine, Slot
from rossmarie.ir.path import Path, Sector, path_names


@dataclass(frozen=True)
class ScanFields:
    """A scan at a path in the messages of an input, and the arrays that are computed from the whole
    scan.
    """

    input: int
    path: Path
    arrays: tuple[int, ...]


def field_names(machine: Machine) -> tuple[tuple[frozenset[str], ...], tuple[frozenset[str], ...]]:
    """The names of each slot, and of each array, by index. No two fields share a name."""
    arrays = [_names(machine, array) for array in machine.arrays]
    slots = [_names(machine, slot) - _names_of_whole(machine, slot) for slot in machine.slots]
    uses = Counter(name for names in (*slots, *arrays) for name in names)

    def own(names: set[str]) -> frozenset[str]:
        return frozenset(name for name in names if uses[name] == 1)

    return tuple(map(own, slots)), tuple(map(own, arrays))


def list_names(machine: Machine) -> tuple[frozenset[str], ...]:
    """The names of each list, by index: names that only the list and its own columns have."""
    slots, arrays = field_names(machine)
    lists = [_names(machine, each) for each in machine.lists]
    uses = Counter(name for names in lists for name in names)
    taken = {name for names in slots for name in names}
    columns = enumerate(zip(machine.arrays, arrays, strict=True))
    owners = {name: array.list for _, (array, names) in columns for name in names}
    return tuple(
        frozenset(
            name
            for name in names
            if uses[name] == 1 and name not in taken and owners.get(name, index) == index
        )
        for index, names in enumerate(lists)
    )


def scan_names(machine: Machine) -> dict[str, ScanFields]:
    """The scans whose sectors or beams rules read, by their unique names: the input, with as much
    of the path as is needed.
    """
    found: dict[tuple[int, Path], list[int]] = {}
    for index, array in enumerate(machine.arrays):
        path = scan_path(array.path)
        if path is not None:
            found.setdefault((array.input, path), []).append(index)
    names: dict[str, list[ScanFields]] = {}
    for (used, path), arrays in found.items():
        for name in _names_at(machine, used, path):
            names.setdefault(name, []).append(ScanFields(used, path, tuple(arrays)))
    return {name: scans[0] for name, scans in names.items() if len(scans) == 1}


def arrival_names(machine: Machine) -> dict[str, int]:
    """The inputs from which rules read only the age: their names, and their channels."""
    slots = {slot.input for slot in machine.slots}
    arrays = {array.input for array in machine.arrays}
    return {
        used.name: used.channel
        for index, used in enumerate(machine.inputs)
        if index not in slots | arrays
    }


def near_name(name: str, known: Iterable[str]) -> str | None:
    """The known name that the user probably meant; for the name of an input, one of its fields."""
    names = sorted(known, key=lambda each: (len(each), each))
    inside = [each for each in names if each.startswith(f"{name}.")]
    return next(iter(inside or difflib.get_close_matches(name, names, n=1)), None)


def _names(machine: Machine, field: Slot | Array | List) -> set[str]:
    """The names of a field: the input, and the input with every end of the path."""
    return _names_at(machine, field.input, field.path)


def _names_at(machine: Machine, used: int, path: Path) -> set[str]:
    name, words = machine.inputs[used].name, path_names(path)
    endings = {".".join(words[start:]) for start in range(len(words))}
    sectors = {f"{name}[{path[-1]}]"} if path and isinstance(path[-1], Sector) else set()
    return {name} | {f"{name}.{ending}" for ending in endings} | sectors


def _names_of_whole(machine: Machine, slot: Slot) -> set[str]:
    """The names of the arrays in which a slot is an element."""
    wholes = (
        array
        for array in machine.arrays
        if array.input == slot.input and array.path == slot.path[: len(array.path)]
    )
    return {name for array in wholes for name in _names(machine, array)}
