"""The fields in the messages of a channel, in the order in which C takes them: the slots of the
machine in their order, then its arrays, then the columns of each list, followed by one count.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rossmarie.ir import model as ir
from rossmarie.ir.path import EACH, Path
from rossmarie.naming.identifiers import c_identifier
from rossmarie.verification.layout import MisplacedError, ProofLayout

SLOT_TYPES = {ir.FieldKind.REAL: "double", ir.FieldKind.FLAG: "bool", ir.FieldKind.TEXT: "int32_t"}
"""The C types of slots in public functions."""


@dataclass(frozen=True)
class CField:
    """A slot or an array of a message, under its name in C. If a count of elements follows it,
    `count` is the name of the count.
    """

    name: str
    slot: int | None = None
    array: int | None = None
    count: str | None = None


def fields_of(layout: ProofLayout, channel: int) -> tuple[CField, ...]:
    """The fields of a channel. Raises `MisplacedError` if a field has the name of another field."""
    lists = enumerate(layout.machine.lists)
    own = [index for index, each in lists if layout.machine.inputs[each.input].channel == channel]
    columns = [field for index in own for field in _columns(layout, index)]
    return (*_slots(layout, channel), *_arrays(layout, channel), *columns)


def _slots(layout: ProofLayout, channel: int) -> Iterator[CField]:
    for index, slot in enumerate(layout.machine.slots):
        if layout.machine.inputs[slot.input].channel == channel:
            yield CField(_named(layout.places.slot_names, index, slot.path), slot=index)


def _arrays(layout: ProofLayout, channel: int) -> Iterator[CField]:
    for index, array in enumerate(layout.machine.arrays):
        if layout.machine.inputs[array.input].channel == channel and array.list is None:
            name = _named(layout.places.array_names, index, array.path)
            yield CField(name, array=index, count=f"{name}_count")


def _columns(layout: ProofLayout, its_list: int) -> Iterator[CField]:
    """S51: the columns of a list, which all have one length."""
    arrays = enumerate(layout.machine.arrays)
    columns = [index for index, array in arrays if array.list == its_list]
    for column in columns:
        name = _named(layout.places.array_names, column, layout.machine.arrays[column].path)
        is_last = column == columns[-1]
        yield CField(name, array=column, count=_count(layout, its_list) if is_last else None)


def _count(layout: ProofLayout, its_list: int) -> str:
    path, names = layout.machine.lists[its_list].path, layout.places.list_names
    return f"{_named(names, its_list, path)}_count"


def _named(names: Mapping[int, str], index: int, path: Path) -> str:
    """The name of a field: its path, followed by a number if the path's name is taken."""
    steps = [str(step) for step in path if step != EACH]
    word, name = c_identifier("_".join(steps) or "value"), names.get(index, "")
    if not re.fullmatch(rf"{re.escape(word)}(_\d+)?", name):
        raise MisplacedError(f"a field at {word} is called {name or 'nothing'}")
    return name


def plain_parameters(field: CField) -> list[str]:
    """The parameters of a field if every scalar is a double."""
    if field.slot is None:
        counts = [] if field.count is None else [f"size_t {field.count}"]
        return [f"const double *{field.name}", *counts]
    return [f"double {field.name}"]


def arguments(field: CField) -> list[str]:
    """The arguments that pass on a field as plain parameters."""
    return [field.name] if field.count is None else [field.name, field.count]
