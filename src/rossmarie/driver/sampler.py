"""The plotted signals of a replay, sampled in constant memory.

A machine without rules runs beside the monitor. After each message, the values of its signals are
noted; whenever there are many, those are kept that a picture needs.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from rossmarie.interpreter import Interpreter
from rossmarie.ir import Machine
from rossmarie.recordings import Update
from rossmarie.report import Axis, Plot, plan_plots, share, thinned

_BLOCK = 20_000
"""Samples that are noted before they are thinned."""


class Sampler:
    """Takes the samples of a replay, message by message."""

    def __init__(self, machine: Machine) -> None:
        self._plans = plan_plots(machine)
        without_rules = dataclasses.replace(machine, rules=())  # signals may count truths
        self._machine = Interpreter(without_rules)
        self._axis = Axis()
        self._times_ns: list[int] = []
        self._rows: list[tuple[float, ...]] = []
        self._kept = [_Kept() for _ in self._plans]
        self._limit = share(len(self._plans))
        self._first_ns: int | None = None
        self._last_ns = 0

    @property
    def instants(self) -> tuple[int, ...]:
        """The instants of the first and the last sample; nothing if there is none."""
        return () if self._first_ns is None else (self._first_ns, self._last_ns)

    def feed(self, update: Update) -> None:
        """Take a sample after a message, and before it wherever an input expires."""
        while (wake_ns := self._machine.next_wake()) is not None and wake_ns < update.at_ns:
            self._machine.advance(wake_ns)
            self._keep(wake_ns)
        self._machine.update(update.at_ns, update.channels)
        self._keep(update.at_ns)

    def _keep(self, at_ns: int) -> None:
        if self._first_ns is None:
            self._first_ns = at_ns
        self._last_ns = at_ns
        values = self._machine.signals
        self._times_ns.append(at_ns)
        self._rows.append(tuple(values[plan.signal] for plan in self._plans))
        if len(self._rows) >= _BLOCK:
            self._thin()

    def _thin(self) -> None:
        """Move what has been noted to what is kept."""
        times = self._axis.place(np.array(self._times_ns, dtype=np.int64))
        values = np.array(self._rows, dtype=np.float64).reshape(len(times), len(self._plans))
        self._times_ns.clear()
        self._rows.clear()
        for column, kept in enumerate(self._kept):
            kept.add(times, values[:, column], self._limit)

    def plots(self, start_ns: int) -> tuple[Plot, ...]:
        """What has been sampled."""
        self._thin()
        first_ns = start_ns if self._first_ns is None else self._first_ns
        return tuple(
            plan.plot((kept.times + (first_ns - start_ns)) / 1e9, kept.values)
            for plan, kept in zip(self._plans, self._kept, strict=True)
        )


class _Kept:
    """The samples of one signal: all, or those that a picture needs of more than twice a limit."""

    def __init__(self) -> None:
        self.times: NDArray[np.int64] = np.empty(0, dtype=np.int64)
        self.values: NDArray[np.float64] = np.empty(0)

    def add(self, times: NDArray[np.int64], values: NDArray[np.float64], limit: int) -> None:
        """More samples, at later positions."""
        self.times = np.concatenate((self.times, times))
        self.values = np.concatenate((self.values, values))
        if len(self.times) > 2 * limit:
            self.times, self.values = thinned(self.times, self.values, limit)
