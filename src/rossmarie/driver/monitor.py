"""A rules file as a running monitor: native where there is a C compiler, in Python elsewhere."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from operator import index as as_index
from os import PathLike
from pathlib import Path
from typing import Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from rossmarie.driver.pipeline import compile_file
from rossmarie.driver.python_columns import PythonColumns
from rossmarie.driver.python_monitor import PythonMonitor
from rossmarie.ir import (
    ChannelValues,
    Event,
    Kind,
    Machine,
    Verdict,
    arrival_names,
    explain,
    field_names,
    near_name,
)
from rossmarie.native import (
    BuildError,
    NativeMonitor,
    NoCompilerError,
    fit,
    load_native,
)
from rossmarie.targets import c99, python

_WANTED = {Kind.REAL: "a number", Kind.FLAG: "a flag", Kind.TEXT: "a string"}
_NUMBERS = (int, float, np.integer, np.floating, np.bool_)

NATIVE = "native"
PYTHON = "python"

Value: TypeAlias = float | bool | str | Sequence[float]
"""The content of a message field: a number, a flag, a string, or the elements of an array."""


class Run(Protocol):
    """The findings of a run over whole columns; worked out when they are asked for."""

    @property
    def events(self) -> list[Event]:
        """All events, in order."""

    @property
    def active(self) -> NDArray[np.bool_]:
        """The rules that were active after each row: of shape (rows, rules).

        Raises `ValueError` if the run was not asked for it.
        """


class Bound(Protocol):
    """Columns that fit a monitor; they must not change while they are used."""

    def run(self, start: int = 0, stop: int | None = None, *, active: bool = False) -> Run:
        """Take in the rows from `start` up to `stop`, or to the end.

        Raises `IndexError` if there are no such rows, `MemoryError` if events were lost.
        """


@dataclass(frozen=True)
class Started:
    """An engine, its kind (`NATIVE` or `PYTHON`), and why it is not native."""

    engine: NativeMonitor | PythonMonitor
    kind: str
    reason: str | None


def start_engine(machine: Machine) -> Started:
    """An engine in its initial state; its verdicts are the same whatever its kind."""
    refused = next(iter(c99.unsupported(machine)), None)
    if refused is not None:
        return _in_python(machine, refused.title)
    try:
        return Started(load_native(machine, c99.generate_loadable(machine)), NATIVE, None)
    except (NoCompilerError, BuildError, OSError) as error:
        return _in_python(machine, str(error).partition("\n")[0])


def _in_python(machine: Machine, why: str) -> Started:
    reason = f"the monitor runs in Python, which is slower: {why}"
    return Started(PythonMonitor(machine, python.source(machine)), PYTHON, reason)


class Monitor:
    """A rules file, running. Fields go by the names of inputs: `speed`, `orientation.x`.

    Instants are integers in nanoseconds on one clock; values are in the units of the messages.
    An instant that is no integer raises `TypeError`, one outside the years 1896 to 2116
    (`ir.EARLIEST_NS`, `ir.LATEST_NS`) `ValueError`; whatever is refused changes nothing.
    """

    def __init__(self, machine: Machine) -> None:
        self.machine = machine
        started = start_engine(machine)
        self._engine = started.engine
        self.kind = started.kind
        self.reason = started.reason
        self._slots, self._arrays = (_by_name(names) for names in field_names(machine))
        self._arrivals = arrival_names(machine)

    def fresh(self) -> Monitor:
        """Another monitor of the same rules, which has seen nothing. It costs next to nothing:
        nothing is generated, built or loaded again.
        """
        another = copy(self)
        another._engine = self._engine.fresh()  # noqa: SLF001 - of this class
        return another

    @property
    def rules(self) -> tuple[str, ...]:
        """The names of the rules."""
        return tuple(rule.name for rule in self.machine.rules)

    @property
    def active(self) -> tuple[str, ...]:
        """The names of the rules that are active."""
        pairs = zip(self.machine.rules, self._engine.active, strict=True)
        return tuple(rule.name for rule, is_active in pairs if is_active)

    def next_wake(self) -> int | None:
        """The instant at which `advance` is wanted if no message comes before, in nanoseconds."""
        return self._engine.next_wake()

    def update(self, at_ns: int, values: Mapping[str, Value]) -> list[Event]:
        """Messages arrive: one on each topic of which a field is named; other fields are unknown.

        An input of which rules read only the age is named by itself, with any value. Raises
        `KeyError` for a name that nothing reads, `TypeError` for a value of another type than the
        field or an instant that is no integer, `OverflowError` for an integer beyond all floats,
        `ValueError` for an instant out of range, `MemoryError` if events were lost for lack of
        memory.
        """
        instant = as_index(at_ns)
        slots: dict[int, dict[int, float]] = {}
        arrays: dict[int, dict[int, Sequence[float]]] = {}
        for name, value in values.items():
            if name in self._slots:
                index = self._slots[name]
                channel = self._channel(self.machine.slots[index].input)
                slots.setdefault(channel, {})[index] = self._number(index, value)
            elif name in self._arrays:
                index = self._arrays[name]
                channel = self._channel(self.machine.arrays[index].input)
                arrays.setdefault(channel, {})[index] = _elements(name, value)
            elif name in self._arrivals:
                slots.setdefault(self._arrivals[name], {})
            else:
                raise KeyError(self._unknown(name))
        messages = {
            channel: ChannelValues(slots.get(channel, {}), arrays.get(channel, {}))
            for channel in slots.keys() | arrays.keys()
        }
        return self._engine.update(instant, messages)

    def advance(self, at_ns: int) -> list[Event]:
        """Time passes without a message; timers due at this very instant fire as well.

        Raises `TypeError` for an instant that is no integer, `ValueError` for one out of range,
        `MemoryError` if events were lost for lack of memory.
        """
        return self._engine.advance(as_index(at_ns))

    def reset(self, at_ns: int, rule: str | None = None) -> list[Event]:
        """An operator resets one latched rule, or all: those with a false condition clear.

        Raises `ValueError` for an unknown rule or an instant out of range, `TypeError` for an
        instant that is no integer, `MemoryError` if events were lost for lack of memory.
        """
        return self._engine.reset(as_index(at_ns), None if rule is None else self.rules.index(rule))

    def explain(self, event: Event) -> str:
        """An event in words: the rule, what happened, and why."""
        if not isinstance(event, Verdict):
            return f"time went back from {event.from_ns} ns to {event.to_ns} ns"
        change = event.change.name.partition("_")[0].lower()
        return f"{self.rules[event.rule]} {change}: {explain(self.machine, event).line()}"

    def update_call(self, topic: str) -> Callable[..., int]:
        """The fastest call for one topic: `(at_ns, *scalars) -> number of events, or -1`.

        The scalars are those that rules read, in the order of `fields(topic)`; -1 is an instant out
        of range. Numbers are Python's own. Events wait for `take_events`. Raises `ValueError` for
        an unknown topic, and for one whose arrays are read.
        """
        return self._engine.update_call(self._topic(topic))

    def take_events(self) -> list[Event]:
        """The events of the calls that `update_call` gave, since the last time.

        Raises `MemoryError` if events were lost for lack of memory.
        """
        return self._engine.take_events()

    def fields(self, topic: str) -> tuple[str, ...]:
        """The scalars of a topic that rules read, in the order of `update_call`; arrays are not
        among them, nor is an input of which only the age is read.

        Raises `ValueError` for a topic that no input reads.
        """
        channel = self._topic(topic)
        names, _ = field_names(self.machine)
        return tuple(
            min(names[index], key=len, default="")
            for index, slot in enumerate(self.machine.slots)
            if self._channel(slot.input) == channel
        )

    def run(self, times_ns: NDArray[np.int64], columns: Mapping[str, NDArray[np.generic]]) -> Run:
        """Whole columns: each row is a message on every topic of which a column is given.

        `times_ns` has the shape (rows,), as every column of scalars has; a column of an array has
        the shape (rows, elements). There is a column for each field that rules read; one for an
        input of which only the age is read may be left out, and then it never arrives. Raises
        `ColumnError`, a `ValueError`, before anything is taken in if the columns do not fit, and
        `MemoryError` if events were lost for lack of memory.
        """
        return self.bind(times_ns, columns).run(active=True)

    def bind(
        self, times_ns: NDArray[np.int64], columns: Mapping[str, NDArray[np.generic]]
    ) -> Bound:
        """Columns as for `run`, looked at once, to be run over in chunks: `bound.run(0, 1000)`.

        Raises `ColumnError` if they do not fit.
        """
        if isinstance(self._engine, NativeMonitor):
            return self._engine.bind(times_ns, columns)
        fitting = fit(self.machine, times_ns, columns)
        return PythonColumns(self.machine, self._engine, fitting)

    # --- names -------------------------------------------------------------------------------

    def _channel(self, used: int) -> int:
        return self.machine.inputs[used].channel

    def _topic(self, topic: str) -> int:
        return [channel.topic for channel in self.machine.channels].index(topic)

    def _number(self, slot: int, value: Value) -> float:
        """A string is its index among the strings of the machine, or -1."""
        kind = self.machine.slots[slot].kind
        if isinstance(value, str) and kind is Kind.TEXT:
            texts = self.machine.texts
            return float(texts.index(value)) if value in texts else -1.0
        if isinstance(value, _NUMBERS) and kind is not Kind.TEXT:
            number = float(value)
            return _flag(number) if kind is Kind.FLAG else number
        raise TypeError(f"{_WANTED[kind]} is wanted, not {value!r}")

    def _unknown(self, name: str) -> str:
        near = near_name(name, (*self._slots, *self._arrays, *self._arrivals))
        return f"no rule reads `{name}`" + (f"; did you mean `{near}`?" if near else "")


def _by_name(names: Sequence[frozenset[str]]) -> dict[str, int]:
    return {name: index for index, known in enumerate(names) for name in known}


def _flag(number: float) -> float:
    return float(number != 0.0) if math.isfinite(number) else math.nan


def _elements(name: str, value: Value) -> list[float]:
    elements = np.asarray(value)
    if elements.ndim != 1 or elements.dtype.kind not in "buif":
        raise TypeError(f"`{name}` is an array of numbers, not {value!r}")
    found: list[float] = elements.astype(np.float64).tolist()
    return found


def load(
    rules: str | PathLike[str],
    *,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
) -> Monitor:
    """The monitor of a rules file. Raises `RulesError`, which holds all that is wrong with it.

    Gives a `RuntimeWarning` with the reason if the monitor is not native.
    """
    compiled = compile_file(Path(rules), systems=systems, message_folders=message_folders)
    monitor = Monitor(compiled.machine)
    if monitor.reason is not None:
        warnings.warn(monitor.reason, RuntimeWarning, stacklevel=2)
    return monitor
