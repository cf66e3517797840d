"""The plotted signals of a replay, sampled in constant memory.

Samples are taken after each message, and before a message if a timer was due. If there are many
samples, only those that affect a picture are kept.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rossmarie.ir import Machine
from rossmarie.report.axis import Axis
from rossmarie.report.envelope import share, thinned
from rossmarie.report.model import Plot
from rossmarie.report.plots import plan_plots

_BLOCK = 20_000
"""The number of samples that are collected before they are thinned."""


class Sampler:
    """Stores the samples of some signals that a picture needs."""

    def __init__(self, machine: Machine) -> None:
        self._plans = plan_plots(machine)
        self.signals = tuple(plan.signal for plan in self._plans)
        self._axis = Axis()
        self._times_ns = np.empty(_BLOCK, np.int64)
        self._values = np.empty((len(self._plans), _BLOCK))
        self._noted = 0
        self._kept = [Kept() for _ in self._plans]
        self._limit = share(len(self._plans))
        self._first_ns: int | None = None
        self._last_ns = 0

    @property
    def instants(self) -> tuple[int, ...]:
        """The instants of the first and the last sample; empty if there is none."""
        return () if self._first_ns is None else (self._first_ns, self._last_ns)

    def take(self, times_ns: NDArray[np.int64], values: NDArray[np.float64]) -> None:
        """Take the next samples: instants, and a row of values at each."""
        if not len(times_ns):
            return
        if self._first_ns is None:
            self._first_ns = int(times_ns[0])
        self._last_ns = int(times_ns[-1])
        while len(times_ns):
            count = min(len(times_ns), _BLOCK - self._noted)
            noted = slice(self._noted, self._noted + count)
            self._times_ns[noted] = times_ns[:count]
            self._values[:, noted] = values[:count].T
            times_ns, values = times_ns[count:], values[count:]
            self._noted += count
            if self._noted == _BLOCK:
                self._thin()

    def _thin(self) -> None:
        """Move the collected samples to the stored samples."""
        times = self._axis.place(self._times_ns[: self._noted])
        for values, kept in zip(self._values, self._kept, strict=True):
            kept.add(times, values[: self._noted], self._limit)
        self._noted = 0

    def plots(self, start_ns: int) -> tuple[Plot, ...]:
        """The plots of the samples."""
        self._thin()
        first_ns = start_ns if self._first_ns is None else self._first_ns
        return tuple(
            plan.plot((kept.times + (first_ns - start_ns)) / 1e9, kept.values)
            for plan, kept in zip(self._plans, self._kept, strict=True)
        )


class Kept:
    """The samples of one signal. All samples are stored up to twice a limit; beyond it, only the
    samples that a picture needs are stored.
    """

    def __init__(self) -> None:
        self.times: NDArray[np.int64] = np.empty(0, dtype=np.int64)
        self.values: NDArray[np.float64] = np.empty(0)

    def add(self, times: NDArray[np.int64], values: NDArray[np.float64], limit: int) -> None:
        """Add samples at later positions."""
        self.times = np.concatenate((self.times, times))
        self.values = np.concatenate((self.values, values))
        if len(self.times) > 2 * limit:
            self.times, self.values = thinned(self.times, self.values, limit)
