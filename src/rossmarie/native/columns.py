"""Whole columns as memory that C reads, and what comes back.

Takes numpy arrays; columns go by the names of `ir.field_names`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.ir import Event
from rossmarie.native.events import EventReader


class ColumnError(ValueError):
    """The columns do not fit the machine, or each other."""


@dataclass(eq=False)
class RunResult:
    """What a run over many rows said.

    `packed_active` has a row of bytes for every row of the run, with the bit of rule r at bit
    `r % 8` of byte `r // 8`; it is None if it was not asked for.
    """

    machine: ir.Machine
    reader: EventReader
    log: bytes
    packed_active: NDArray[np.uint8] | None

    @cached_property
    def events(self) -> list[Event]:
        """All events, in order."""
        return self.reader.read(self.log)

    @cached_property
    def active(self) -> NDArray[np.bool_]:
        """Which rules were active behind each row: of shape (rows, rules).

        Raises `ValueError` if the run was not asked for it.
        """
        if self.packed_active is None:
            raise ValueError("run with active=True to learn which rules were active")
        rules = len(self.machine.rules)
        bits = np.unpackbits(self.packed_active, axis=1, count=rules, bitorder="little")
        return bits.view(np.bool_)


def order_of(machine: ir.Machine, given: tuple[str, ...]) -> list[str]:
    """Which of the given columns feeds each slot.

    Raises `ColumnError` if one is missing or fits no slot, or if the machine reads arrays.
    """
    if machine.arrays:
        raise ColumnError("a machine that reads arrays cannot run over columns")
    chosen = []
    for names in ir.field_names(machine)[0]:
        fitting = [name for name in given if name in names]
        if len(fitting) != 1:
            wanted = " or ".join(sorted(names, key=len)) or "a scalar with no name of its own"
            raise ColumnError(f"{len(fitting) or 'no'} columns for {wanted}")
        chosen += fitting
    if unknown := sorted(set(given) - set(chosen)):
        raise ColumnError(f"nothing reads the column {unknown[0]}")
    return chosen


def as_instants(times_ns: NDArray[np.int64]) -> NDArray[np.int64]:
    """Instants as C reads them; raises `ColumnError` if they are no integers."""
    if times_ns.dtype != np.int64 or times_ns.ndim != 1:
        raise ColumnError("instants are one column of int64 nanoseconds")
    return np.ascontiguousarray(times_ns)


def as_column(
    name: str, kind: ir.Kind, column: NDArray[np.generic], rows: int
) -> NDArray[np.generic]:
    """A column as C reads it; raises `ColumnError` if it has another length."""
    if column.shape != (rows,):
        raise ColumnError(f"column {name} has shape {column.shape}, the instants ({rows},)")
    if kind is ir.Kind.FLAG:
        is_ready = column.dtype == np.uint8 and column.flags.c_contiguous
        return column if is_ready else np.ascontiguousarray(column, np.bool_).view(np.uint8)
    return np.ascontiguousarray(column, np.float64)
