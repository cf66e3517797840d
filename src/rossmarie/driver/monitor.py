"""A rules file as a running monitor: native where there is a C compiler, interpreted elsewhere."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from rossmarie.driver.pipeline import compile_file
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, Event, Kind, Machine, Verdict, explain, field_names
from rossmarie.native import (
    BoundColumns,
    BuildError,
    NativeMonitor,
    NoCompilerError,
    load_native,
)
from rossmarie.targets import c99

NATIVE = "native"
INTERPRETER = "interpreter"

Value: TypeAlias = float | bool | str | Sequence[float]
"""What a message field holds: a number, a flag, a text, or the elements of an array."""


class Engine(Protocol):
    """What runs a machine. Messages are given by channel, fields by index."""

    @property
    def active(self) -> tuple[bool, ...]:
        """Which rules are active, by index."""

    def next_wake(self) -> int | None:
        """The instant at which `advance` is wanted if no message comes before."""

    def update(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> list[Event]:
        """The messages that arrive at one instant, by channel index."""

    def advance(self, at_ns: int) -> list[Event]:
        """Time passes without a message."""

    def reset(self, at_ns: int, rule: int | None = None) -> list[Event]:
        """An operator resets one latched rule, or all."""


class Run(Protocol):
    """What a run over whole columns found; worked out when it is asked for."""

    @property
    def events(self) -> list[Event]:
        """All events, in order."""

    @property
    def active(self) -> NDArray[np.bool_]:
        """Which rules were active behind each row: of shape (rows, rules)."""


@dataclass(frozen=True)
class InterpretedRun:
    """A `Run` of the interpreter."""

    events: list[Event]
    active: NDArray[np.bool_]


@dataclass(frozen=True)
class Started:
    """An engine, its kind (`NATIVE` or `INTERPRETER`), and why it is not native."""

    engine: Engine
    kind: str
    reason: str | None


def start_engine(machine: Machine) -> Started:
    """An engine in its initial state; its verdicts are the same whatever its kind."""
    refused = next(iter(c99.unsupported(machine)), None)
    if refused is not None:
        return _interpreted(machine, refused.title)
    try:
        return Started(load_native(machine, c99.generate_loadable(machine)), NATIVE, None)
    except (NoCompilerError, BuildError, OSError) as error:
        return _interpreted(machine, str(error))


def _interpreted(machine: Machine, why: str) -> Started:
    reason = f"the monitor is interpreted, which is slower: {why}"
    return Started(Interpreter(machine), INTERPRETER, reason)


class Monitor:
    """A rules file, running. Fields go by the names of inputs: `speed`, `orientation.x`.

    Instants are integers in nanoseconds on one clock; values are in the units of the messages.
    """

    def __init__(self, machine: Machine) -> None:
        self.machine = machine
        started = start_engine(machine)
        self._engine = started.engine
        self.kind = started.kind
        self.reason = started.reason
        self._slots, self._arrays = (_by_name(names) for names in field_names(machine))

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

        Raises `KeyError` for a name that is no field, `ValueError` for an instant out of range.
        """
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
            else:
                raise KeyError(self._unknown(name))
        messages = {
            channel: ChannelValues(slots.get(channel, {}), arrays.get(channel, {}))
            for channel in slots.keys() | arrays.keys()
        }
        return self._engine.update(at_ns, messages)

    def advance(self, at_ns: int) -> list[Event]:
        """Time passes without a message."""
        return self._engine.advance(at_ns)

    def reset(self, at_ns: int, rule: str | None = None) -> list[Event]:
        """An operator resets one latched rule, or all. Raises `ValueError` for an unknown rule."""
        return self._engine.reset(at_ns, None if rule is None else self.rules.index(rule))

    def explain(self, event: Event) -> str:
        """An event in words: the rule, what happened, and why."""
        if not isinstance(event, Verdict):
            return f"time went back from {event.from_ns} ns to {event.to_ns} ns"
        change = event.change.name.partition("_")[0].lower()
        return f"{self.rules[event.rule]} {change}: {explain(self.machine, event).line()}"

    def update_call(self, topic: str) -> Callable[..., int]:
        """The fastest call for one topic: `(at_ns, *scalars) -> number of events, or -1`.

        The scalars are those that rules read, in the order of `fields(topic)`; -1 is an instant out
        of range. Events wait for `take_events`. Raises `ValueError` for an unknown topic, for one
        whose arrays are read, and for an interpreted monitor.
        """
        return self._native("update_call").update_call(self._topic(topic))

    def take_events(self) -> list[Event]:
        """The events of the calls that `update_call` gave, since the last time."""
        return self._native("take_events").take_events()

    def fields(self, topic: str) -> tuple[str, ...]:
        """The scalars of a topic that rules read. Raises `ValueError` for an unknown topic."""
        channel = self._topic(topic)
        names, _ = field_names(self.machine)
        return tuple(
            min(names[index], key=len)
            for index, slot in enumerate(self.machine.slots)
            if self._channel(slot.input) == channel
        )

    def run(self, times_ns: NDArray[np.int64], columns: Mapping[str, NDArray[np.generic]]) -> Run:
        """Whole columns: every topic is updated at each instant with the values of that row.

        `times_ns` has the shape (rows,), as every column has; there is a column for each field.
        Raises `ValueError` if the columns do not fit.
        """
        if isinstance(self._engine, NativeMonitor):
            return self._engine.run(times_ns, columns, active=True)
        events: list[Event] = []
        active = np.zeros((len(times_ns), len(self.rules)), dtype=np.bool_)
        rows = zip(*(column.tolist() for column in columns.values()), strict=True)
        for index, row in enumerate(rows):
            events += self.update(int(times_ns[index]), dict(zip(columns, row, strict=True)))
            active[index] = self._engine.active
        return InterpretedRun(events, active)

    def bind(
        self, times_ns: NDArray[np.int64], columns: Mapping[str, NDArray[np.generic]]
    ) -> BoundColumns:
        """Columns as for `run`, looked at once, to be run over in chunks: `bound.run(0, 1000)`.

        Raises `ValueError` if they do not fit, and for an interpreted monitor.
        """
        return self._native("bind").bind(times_ns, columns)

    # --- names -------------------------------------------------------------------------------

    def _native(self, call: str) -> NativeMonitor:
        if not isinstance(self._engine, NativeMonitor):
            raise ValueError(f"{call} needs a native monitor: {self.reason}")
        return self._engine

    def _channel(self, used: int) -> int:
        return self.machine.inputs[used].channel

    def _topic(self, topic: str) -> int:
        return [channel.topic for channel in self.machine.channels].index(topic)

    def _number(self, slot: int, value: Value) -> float:
        """A text is its index among the texts of the machine, or -1."""
        kind = self.machine.slots[slot].kind
        if isinstance(value, str) and kind is Kind.TEXT:
            texts = self.machine.texts
            return float(texts.index(value)) if value in texts else -1.0
        if isinstance(value, (int, float)) and kind is not Kind.TEXT:
            return float(value)
        raise TypeError(f"a {kind.value} is wanted, not {value!r}")

    def _unknown(self, name: str) -> str:
        known = [*self._slots, *self._arrays]
        near = difflib.get_close_matches(name, known, n=1)
        return f"no rule reads `{name}`" + (f"; did you mean `{near[0]}`?" if near else "")


def _by_name(names: Sequence[frozenset[str]]) -> dict[str, int]:
    return {name: index for index, known in enumerate(names) for name in known}


def _elements(name: str, value: Value) -> Sequence[float]:
    if isinstance(value, (str, int, float)):
        raise TypeError(f"`{name}` is an array")
    return value


def load(
    rules: str | PathLike[str],
    *,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
) -> Monitor:
    """The monitor of a rules file. Raises `RulesError`, which holds all that is wrong with it."""
    return Monitor(
        compile_file(Path(rules), systems=systems, message_folders=message_folders).machine
    )
