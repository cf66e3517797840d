"""Whole columns and packed messages as memory that C reads, and what comes back.

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


@dataclass(frozen=True)
class PackedMessages:
    """Messages of all channels in order of time, for one call.

    Message i arrives at `times_ns[i]` on channel `channels[i]`. `slots` holds the scalars of its
    slots in index order, message after message; `counts` the lengths of its arrays in index order,
    and `elements` their elements. All in the units of the messages.
    """

    times_ns: NDArray[np.int64]
    channels: NDArray[np.int32]
    slots: NDArray[np.float64]
    counts: NDArray[np.uint64]
    elements: NDArray[np.float64]


def check_packed(machine: ir.Machine, messages: PackedMessages) -> None:
    """Raise `ColumnError` unless the parts fit together: C trusts them."""
    channels = len(machine.channels)
    arrived = messages.channels
    if arrived.shape != messages.times_ns.shape:
        raise ColumnError("every message has one instant and one channel")
    if arrived.size and not (arrived.min() >= 0 and arrived.max() < channels):
        raise ColumnError(f"channels are numbered from 0 to {channels - 1}")
    counted = np.bincount(arrived, minlength=channels)
    slots = _per_channel(machine, [slot.input for slot in machine.slots])
    arrays = _per_channel(machine, [array.input for array in machine.arrays])
    _require_size("slots", messages.slots.size, int(counted @ slots))
    _require_size("counts", messages.counts.size, int(counted @ arrays))
    _require_size("elements", messages.elements.size, int(messages.counts.sum()))


def _per_channel(machine: ir.Machine, inputs: list[int]) -> NDArray[np.int64]:
    found = np.zeros(max(1, len(machine.channels)), np.int64)
    for used in inputs:
        found[machine.inputs[used].channel] += 1
    return found


def _require_size(name: str, found: int, wanted: int) -> None:
    if found != wanted:
        raise ColumnError(f"{name} has {found} entries, the messages need {wanted}")


def contiguous(messages: PackedMessages) -> PackedMessages:
    """The same messages as C reads them."""
    return PackedMessages(
        np.ascontiguousarray(messages.times_ns, np.int64),
        np.ascontiguousarray(messages.channels, np.int32),
        np.ascontiguousarray(messages.slots, np.float64),
        np.ascontiguousarray(messages.counts, np.uint64),
        np.ascontiguousarray(messages.elements, np.float64),
    )
