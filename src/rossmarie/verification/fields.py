"""The fields that the messages of a channel carry, in the order in which C takes them: the slots of
the machine in their order, then its arrays.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rossmarie.ir import model as ir
from rossmarie.ir.path import Path
from rossmarie.naming.identifiers import c_identifier
from rossmarie.verification.layout import Layout, MisplacedError

SLOT_TYPES = {ir.Kind.REAL: "double", ir.Kind.FLAG: "bool", ir.Kind.TEXT: "int32_t"}
"""The types of slots in public functions."""


@dataclass(frozen=True)
class Field:
    """A slot or an array of a message, under the name that it has in C."""

    name: str
    slot: int | None = None
    array: int | None = None


def fields_of(layout: Layout, channel: int) -> tuple[Field, ...]:
    """The fields of a channel. Raises `MisplacedError` if one is called after another."""
    return (*_slots(layout, channel), *_arrays(layout, channel))


def _slots(layout: Layout, channel: int) -> Iterator[Field]:
    for index, slot in enumerate(layout.machine.slots):
        if layout.machine.inputs[slot.input].channel == channel:
            yield Field(_named(layout.places.slot_names, index, slot.path), slot=index)


def _arrays(layout: Layout, channel: int) -> Iterator[Field]:
    for index, array in enumerate(layout.machine.arrays):
        if layout.machine.inputs[array.input].channel == channel:
            yield Field(_named(layout.places.array_names, index, array.path), array=index)


def _named(names: Mapping[int, str], index: int, path: Path) -> str:
    """A field is called after its path, with a number behind it where that is taken."""
    word, name = c_identifier("_".join(map(str, path)) or "value"), names.get(index, "")
    if not re.fullmatch(rf"{re.escape(word)}(_\d+)?", name):
        raise MisplacedError(f"a field at {word} is called {name or 'nothing'}")
    return name


def plain_parameters(field: Field) -> list[str]:
    """The parameters of a field where every scalar is a double."""
    if field.slot is None:
        return [f"const double *{field.name}", f"size_t {field.name}_count"]
    return [f"double {field.name}"]


def arguments(field: Field) -> list[str]:
    """The field handed on as plain parameters."""
    return [field.name, f"{field.name}_count"] if field.slot is None else [field.name]
