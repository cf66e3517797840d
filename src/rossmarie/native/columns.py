"""Whole columns in memory for C, checked against the machine that reads them.

The input is NumPy arrays by the names of `ir.field_names` and `ir.arrival_names`. The requirements
are the same for every engine: only this module accepts or refuses columns.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir

FLAG_VALUES = (0.0, 1.0, float("nan"))
"""The values for the bytes in a column of flags; `host.c` has the same table."""

_UNKNOWN_FLAG = 2
_WANTED = {ir.FieldKind.REAL: "numbers", ir.FieldKind.FLAG: "flags"}
_NUMBERS = "buif"  # the kinds of NumPy types: bool, unsigned, signed and floating-point numbers
_Number = TypeVar("_Number", np.float64, np.uint8)


class ColumnError(ValueError):
    """The columns do not fit the machine, or each other."""


@dataclass(frozen=True, eq=False)
class MachineColumns:
    """Columns that fit a machine.

    `times_ns` has the shape (rows,), in ns. `slots` has a column of the same shape for each slot:
    float64, or for flags uint8, an index into `FLAG_VALUES`. `arrays` has a float64 table of shape
    (rows, elements) for each array. `arriving` is 1 for each channel with a message in every row,
    else 0.
    """

    times_ns: NDArray[np.int64]
    slots: tuple[NDArray[np.generic], ...]
    arrays: tuple[NDArray[np.float64], ...]
    arriving: NDArray[np.uint8]


def fit(
    machine: ir.Machine, times_ns: NDArray[np.int64], columns: Mapping[str, NDArray[np.generic]]
) -> MachineColumns:
    """The columns in the form for engines.

    Raises `ColumnError` if a column is missing or unused, if its shape differs from that of the
    instants, if its values have a wrong type, or if the instants are not int64 or out of range.
    """
    instants = _instants(np.asarray(times_ns))
    given = {name: np.asarray(column) for name, column in columns.items()}
    for name, column in given.items():
        if column.shape[:1] != instants.shape:
            raise ColumnError(
                f"column {name} has shape {column.shape}, the instants {instants.shape}"
            )
    slot_names, array_names = (_chosen(given, names) for names in ir.field_names(machine))
    arrivals = ir.arrival_names(machine)
    if unknown := sorted(given.keys() - {*slot_names, *array_names, *arrivals}):
        raise ColumnError(f"no rule reads the column {unknown[0]}")
    return MachineColumns(
        instants,
        tuple(
            _scalars(machine, name, slot.kind, given[name])
            for name, slot in zip(slot_names, machine.slots, strict=True)
        ),
        _tables(machine, array_names, given),
        _arriving(machine, {arrivals[name] for name in given.keys() & arrivals.keys()}),
    )


def _chosen(
    given: Mapping[str, NDArray[np.generic]], fields: tuple[frozenset[str], ...]
) -> list[str]:
    """The given column for each field."""
    chosen = []
    for names in fields:
        fitting = sorted(names & given.keys())
        if len(fitting) != 1:
            wanted = " or ".join(sorted(names, key=lambda name: (len(name), name)))
            raise ColumnError(
                f"{len(fitting) or 'no'} columns for {wanted or 'a field with no name of its own'}"
            )
        chosen += fitting
    return chosen


def _arriving(machine: ir.Machine, named: set[int]) -> NDArray[np.uint8]:
    """The channels with messages: channels with given columns, and named channels."""
    read = {slot.input for slot in machine.slots} | {array.input for array in machine.arrays}
    arriving = np.zeros(max(1, len(machine.channels)), np.uint8)
    arriving[sorted(named.union(machine.inputs[index].channel for index in read))] = 1
    return arriving


# --- values ----------------------------------------------------------------------------------


def _instants(times_ns: NDArray[np.generic]) -> NDArray[np.int64]:
    if times_ns.dtype != np.int64 or times_ns.ndim != 1:
        raise ColumnError(
            "instants are one column of int64 nanoseconds, "
            f"not of {times_ns.dtype} and shape {times_ns.shape}"
        )
    instants = np.ascontiguousarray(times_ns, np.int64)
    earliest, latest = ir.EARLIEST_NS + 1, ir.LATEST_NS - 1
    if instants.size and not earliest <= instants.min() <= instants.max() <= latest:
        outside = (instants < earliest) | (instants > latest)
        raise ColumnError(f"the instant of row {outside.argmax()} is out of range")
    return instants


def _scalars(
    machine: ir.Machine, name: str, kind: ir.FieldKind, column: NDArray[np.generic]
) -> NDArray[np.generic]:
    if column.ndim != 1:
        raise ColumnError(f"column {name} has shape {column.shape}, but holds one scalar a row")
    if kind is ir.FieldKind.TEXT:
        return _strings(machine, name, column)
    if column.dtype.kind not in _NUMBERS:
        raise ColumnError(f"column {name} holds {column.dtype}, not {_WANTED[kind]}")
    match kind:
        case ir.FieldKind.FLAG:
            return _flags(column)
        case ir.FieldKind.REAL:
            return _aligned(column, np.float64)


def _strings(machine: ir.Machine, name: str, column: NDArray[np.generic]) -> NDArray[np.generic]:
    """The index of each string among the strings of the machine; -1 for any other string."""
    values = column.tolist()
    if not all(isinstance(value, str) for value in values):
        raise ColumnError(f"column {name} holds {column.dtype}, not only strings")
    indexes = {text: float(index) for index, text in enumerate(machine.texts)}
    return np.array([indexes.get(value, -1.0) for value in values], np.float64)


def _flags(column: NDArray[np.generic]) -> NDArray[np.uint8]:
    """The flags, always as a copy: a byte in the caller's memory could exceed the table in C."""
    if column.dtype == np.bool_:
        column = column.view(np.uint8)
    flags = (column != 0).view(np.uint8)
    if column.dtype.kind == "f":
        flags[~np.isfinite(column.astype(np.float64, copy=False))] = _UNKNOWN_FLAG
    return _aligned(flags, np.uint8)


def _tables(
    machine: ir.Machine, names: list[str], given: Mapping[str, NDArray[np.generic]]
) -> tuple[NDArray[np.float64], ...]:
    """A table for each array. Tables of one list have equal widths."""
    tables = []
    for name, array in zip(names, machine.arrays, strict=True):
        is_text = array.kind is ir.FieldKind.TEXT
        table = _texts(machine, name, given[name]) if is_text else _elements(name, given[name])
        tables.append(table)
    for each in range(len(machine.lists)):
        first, *others = ir.columns_of(machine, each)
        for other in others:
            if tables[other].shape != tables[first].shape:
                raise ColumnError(
                    f"columns {names[first]} and {names[other]} belong to one list, but have the "
                    f"shapes {tables[first].shape} and {tables[other].shape}"
                )
    for cloud in ir.point_columns(machine):
        for axis in cloud.axes:
            _require_places(names[axis], tables[axis])
    return tuple(tables)


def _require_places(name: str, table: NDArray[np.float64]) -> None:
    """Require that all rows of a table have the same number of points. Points without a position
    cannot be left out of a table (S57).
    """
    lacks = np.isnan(table).any(axis=1)
    if lacks.any():
        raise ColumnError(
            f"column {name} has a point without a position in row {lacks.argmax()}: pass such "
            "clouds one by one, with `update`"
        )


def _texts(machine: ir.Machine, name: str, column: NDArray[np.generic]) -> NDArray[np.float64]:
    if column.ndim != 2:
        raise ColumnError(
            f"column {name} has strings of shape (rows, elements), not of shape {column.shape}"
        )
    indexes = _strings(machine, name, column.reshape(-1))
    return indexes.astype(np.float64).reshape(column.shape)


def _elements(name: str, column: NDArray[np.generic]) -> NDArray[np.float64]:
    if column.ndim != 2 or column.dtype.kind not in _NUMBERS:
        raise ColumnError(
            f"column {name} is an array: numbers of shape (rows, elements), "
            f"not {column.dtype} of shape {column.shape}"
        )
    return _aligned(column, np.float64)


def _aligned(column: NDArray[np.generic], kind: type[_Number]) -> NDArray[_Number]:
    """A column in the memory layout of C. Numbers that are too large for float64 become infinite,
    which counts as unknown.
    """
    with np.errstate(over="ignore"):
        return np.ascontiguousarray(column, kind)
