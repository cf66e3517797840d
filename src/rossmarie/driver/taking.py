"""Turns batches of updates into events, and samples of the signals that a timeline shows.

The native monitor provides both. A monitor in Python stores only the numbers that it needs, so the
interpreter runs beside it for the samples.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.interpreter import Interpreter
from rossmarie.ir import Batch, Event, Machine, Taken, each_update
from rossmarie.native import NativeMonitor


def taking(
    machine: Machine, engine: NativeMonitor | PythonMonitor, shown: Sequence[int]
) -> Callable[[Batch], Taken]:
    """A function that processes the batches of a recording, one after another."""
    match engine:
        case NativeMonitor():
            return partial(engine.take, shown=shown)
        case PythonMonitor():
            return Beside(machine, engine, shown).take


class Beside:
    """A monitor with the interpreter beside it."""

    def __init__(
        self, machine: Machine, engine: NativeMonitor | PythonMonitor, shown: Sequence[int]
    ) -> None:
        self._machine = machine
        self._engine = engine
        self._shown = shown
        without_rules = dataclasses.replace(machine, rules=())  # signals may depend on propositions
        self._interpreter = Interpreter(without_rules)
        self._times_ns: list[int] = []
        self._rows: list[list[float]] = []

    def take(self, batch: Batch) -> Taken:
        """Process the updates of a batch. Raises `ValueError` at an instant out of range."""
        self._times_ns, self._rows = [], []
        events: list[Event] = []
        for at_ns, messages in each_update(self._machine, batch):
            events += self._engine.update(at_ns, messages)
            while (wake_ns := self._interpreter.next_wake()) is not None and wake_ns < at_ns:
                self._interpreter.advance(wake_ns)
                self._sample(wake_ns)
            self._interpreter.update(at_ns, messages)
            self._sample(at_ns)
        values = np.array(self._rows, np.float64).reshape(len(self._rows), len(self._shown))
        return Taken(events, np.array(self._times_ns, np.int64), values)

    def _sample(self, at_ns: int) -> None:
        values = self._interpreter.signals
        self._times_ns.append(at_ns)
        self._rows.append([values[signal] for signal in self._shown])
