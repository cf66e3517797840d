"""The forms of numbers and parameters in C."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.naming import c_identifier
from rossmarie.targets.c99 import names

SLOT_TYPES = {ir.FieldKind.REAL: "double", ir.FieldKind.FLAG: "bool", ir.FieldKind.TEXT: "int32_t"}
"""The C types of slots in public functions."""


def number(value: float) -> str:
    """A double as a literal that reads back to the same bits, in parentheses if negative."""
    if math.isinf(value):
        return "INFINITY" if value > 0 else "(-INFINITY)"
    text = repr(value)
    return f"({text})" if text.startswith("-") else text


def duration(nanoseconds: int) -> str:
    """An integer literal of 64 bits."""
    return f"INT64_C({nanoseconds})"


@dataclass(frozen=True)
class StructField:
    """A slot, an array, or a column of a list of a channel's message, under the name of its
    parameter. `count` is the parameter after it with the number of elements. The columns of a list
    share one count, after the last column.
    """

    name: str
    slot: int | None = None
    array: int | None = None
    count: str | None = None


def fields_of(machine: ir.Machine, channel: int) -> tuple[StructField, ...]:
    """The fields that the messages of a channel carry: its slots, its arrays, and the columns of
    its lists.
    """
    # The functions with fields as parameters call functions that are named after channels.
    called = [
        f"{step}_{c_identifier(topic.topic)}"
        for step in ("receive", "fold", "settle", "late", "take")
        for topic in machine.channels
    ]
    family = names.Family(taken=called)

    def named(path: ir.Path, *endings: str) -> str:
        return family.name("_".join(ir.path_names(path)) or "value", *endings)

    def is_here(used: int) -> bool:
        return machine.inputs[used].channel == channel

    slots = [
        StructField(named(slot.path), slot=index)
        for index, slot in enumerate(machine.slots)
        if is_here(slot.input)
    ]
    arrays = []
    for index, array in enumerate(machine.arrays):
        if is_here(array.input) and array.list is None:
            name = named(array.path, "_count")
            arrays.append(StructField(name, array=index, count=f"{name}_count"))
    columns = []
    for index, each in enumerate(machine.lists):
        if is_here(each.input):
            *before, last = ir.columns_of(machine, index)
            count = f"{named(each.path, '_count')}_count"
            columns += [StructField(named(machine.arrays[i].path), array=i) for i in before]
            columns.append(StructField(named(machine.arrays[last].path), array=last, count=count))
    return (*slots, *arrays, *columns)


def public_parameters(machine: ir.Machine, field: StructField) -> list[str]:
    """The parameters of a field in the public function."""
    if field.slot is None:
        return _array_parameters(field)
    return [f"{SLOT_TYPES[machine.slots[field.slot].kind]} {field.name}"]


def plain_parameters(field: StructField) -> list[str]:
    """The parameters of a field if every scalar is a double."""
    return _array_parameters(field) if field.slot is None else [f"double {field.name}"]


def arguments(field: StructField, prefix: str = "") -> list[str]:
    """The arguments that pass the field on as plain parameters."""
    counts = [] if field.count is None else [field.count]
    return [f"{prefix}{name}" for name in (field.name, *counts)]


def _array_parameters(field: StructField) -> list[str]:
    counts = [] if field.count is None else [f"size_t {field.count}"]
    return [f"const double *{field.name}", *counts]
