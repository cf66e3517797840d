"""What users call the fields that a machine reads: by input, and by as much path as it takes.

An input that carries one field is called by its name alone (`speed`); where there are several,
the last words of the path tell them apart (`orientation.x`). Any longer ending is good as well.
"""

from __future__ import annotations

from collections import Counter

from rossmarie.ir.model import Array, Machine, Slot


def field_names(machine: Machine) -> tuple[tuple[frozenset[str], ...], tuple[frozenset[str], ...]]:
    """The names of each slot, and of each array, by index; no name is that of two fields."""
    slots = [_names(machine, slot) for slot in machine.slots]
    arrays = [_names(machine, array) for array in machine.arrays]
    uses = Counter(name for names in (*slots, *arrays) for name in names)

    def own(names: set[str]) -> frozenset[str]:
        return frozenset(name for name in names if uses[name] == 1)

    return tuple(map(own, slots)), tuple(map(own, arrays))


def _names(machine: Machine, field: Slot | Array) -> set[str]:
    """The input, and the input with every ending of the path."""
    name = machine.inputs[field.input].name
    words = [str(word) for word in field.path]
    endings = {".".join(words[start:]) for start in range(len(words))}
    return {name} | {f"{name}.{ending}" for ending in endings}
