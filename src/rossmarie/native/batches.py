"""Batches of updates, and memory for samples, in the layout of `batch.c`."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rossmarie.ir import Batch
from rossmarie.native.library import NativeLibrary

_ROOM = 1024
"""The samples that the memory can hold in addition to one per update, for timers."""


class BatchTable:
    """A batch in C. The table must live while `pointer` is used."""

    def __init__(self, library: NativeLibrary, batch: Batch) -> None:
        elements = [library.pointer("double[]", array.values) for array in batch.arrays]
        ends = [library.pointer("int64_t[]", array.ends) for array in batch.arrays]
        known = [library.pointer("unsigned char[]", array.known) for array in batch.arrays]
        arrays = max(1, len(batch.arrays))
        members = {
            "update_count": len(batch.times_ns),
            "channel_count": batch.arriving.shape[1],
            "slot_count": batch.slots.shape[1],
            "array_count": len(batch.arrays),
            "times": library.pointer("int64_t[]", batch.times_ns),
            "arriving": library.pointer("unsigned char[]", batch.arriving),
            "slots": library.pointer("double[]", batch.slots),
            "elements": library.new("double *[]", elements or [library.null]),
            "ends": library.new("int64_t *[]", ends or [library.null]),
            "known": library.new("unsigned char *[]", known or [library.null]),
            "parts": library.new("double *[]", arrays),
            "counts": library.new("size_t[]", arrays),
        }
        self.pointer = library.new("host_batch *", members)
        self._memory = (batch, members)


class SampleTable:
    """Memory for samples of some signals while a batch is processed."""

    def __init__(self, library: NativeLibrary, updates: int, signals: Sequence[int]) -> None:
        self._times_ns = np.empty(updates + _ROOM, np.int64)
        self._values = np.empty((len(self._times_ns), len(signals)))
        self._members = {
            "room": len(self._times_ns),
            "count": 0,
            "signal_count": len(signals),
            "signals": library.new("int[]", list(signals) or [0]),
            "times": library.pointer("int64_t[]", self._times_ns),
            "values": library.pointer("double[]", self._values),
        }
        self.pointer = library.new("host_samples *", self._members)

    @property
    def is_full(self) -> bool:
        """True if the memory is full."""
        return bool(self.pointer.count == self.pointer.room)

    def move_out(self) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        """The instants in ns and the values of the samples. Afterwards the memory is free again."""
        times_ns = self._times_ns[: self.pointer.count].copy()
        values = self._values[: self.pointer.count].copy()
        values[np.isnan(values)] = np.nan  # one plain NaN instead of many kinds of NaN
        self.pointer.count = 0
        return times_ns, values
