"""All values that rules read from a scan, computed from the message itself."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from rossmarie.ir import Array, ChannelValues, FieldKind, Machine, Path, ScanFields, Slot
from rossmarie.ir.beams import is_of_scan
from rossmarie.ir.scans import LaserScan, all_taken


def values_of_scan(
    machine: Machine, fields: ScanFields, scan: LaserScan
) -> tuple[int, ChannelValues]:
    """The channel of a scan, and the values that the machine reads there: its sectors and beams
    (S70), and its plain fields.
    """
    arrays: dict[int, Sequence[float]] = {**all_taken(machine, scan, fields.arrays)}
    for index, array in enumerate(machine.arrays):
        if _is_inside(array, fields) and not is_of_scan(array):
            arrays[index] = [float(each) for each in _along(scan, array.path[len(fields.path) :])]
    slots = {
        index: _number(machine, slot, _along(scan, slot.path[len(fields.path) :]))
        for index, slot in enumerate(machine.slots)
        if _is_inside(slot, fields)
    }
    return machine.inputs[fields.input].channel, ChannelValues(slots, arrays)


def _is_inside(field: Slot | Array, fields: ScanFields) -> bool:
    return field.input == fields.input and field.path[: len(fields.path)] == fields.path


def _along(value: Any, path: Path) -> Any:
    """The field at the end of a path; None for an element that does not exist."""
    for step in path:
        if isinstance(step, str):
            value = getattr(value, step)
        else:
            is_there = isinstance(step, int) and step < len(value)
            value = value[step] if is_there else None
    return value


def _number(machine: Machine, slot: Slot, value: Any) -> float:
    if slot.kind is FieldKind.TEXT:
        return float(machine.texts.index(value)) if value in machine.texts else -1.0
    if hasattr(value, "nanosec"):
        return float(value.sec) + float(value.nanosec) * 1e-9
    return math.nan if value is None else float(value)
