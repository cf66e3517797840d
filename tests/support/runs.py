"""Ways to drive a monitor: message by message, by its fastest calls, in columns."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.driver.monitor import Bound
from rossmarie.interpreter import Interpreter
from rossmarie.native.signatures import fields_of
from support.machines import NAN, Monitor, Step, exactly, machines, traces
from support.tables import Table, tables


@dataclass(frozen=True)
class Case:
    """A machine, and what happens to it: step by step, and as a table in chunks."""

    machine: ir.Machine
    trace: list[Step]
    table: Table
    chunk: int


@st.composite
def whole_cases(draw: st.DrawFn) -> Case:
    machine = draw(machines())
    return Case(machine, draw(traces(machine)), draw(tables(machine)), draw(st.integers(1, 17)))


# --- by the fastest calls --------------------------------------------------------------------


class FastMonitor(Monitor, Protocol):
    """A monitor that has fast calls."""

    def update_call(self, channel: int) -> Callable[..., int]:
        """A function of the instant and the numbers of a channel."""

    def take_events(self) -> Sequence[ir.Event]:
        """The events that such functions found."""


class FastCalls:
    """A monitor whose messages come by `update_call` wherever it takes them."""

    def __init__(self, machine: ir.Machine, monitor: FastMonitor) -> None:
        self._machine = machine
        self._monitor = monitor
        self._fields = fields_of(machine)
        self.next_wake = monitor.next_wake
        self.advance = monitor.advance
        self.reset = monitor.reset

    @property
    def active(self) -> tuple[bool, ...]:
        return self._monitor.active

    def update(self, at_ns: int, messages: Mapping[int, ir.ChannelValues]) -> Sequence[ir.Event]:
        (channel, *others) = messages
        if others or self._fields[channel].arrays:
            return self._monitor.update(at_ns, messages)
        values = messages[channel].slots
        numbers = [values.get(slot, NAN) for slot in self._fields[channel].slots]
        count = self.call(channel, at_ns, numbers)
        events = self._monitor.take_events()
        assert count == len(events)
        return events

    def call(self, channel: int, at_ns: int, numbers: list[float]) -> int:
        return self._monitor.update_call(channel)(at_ns, *numbers)


# --- in columns ------------------------------------------------------------------------------


def in_chunks(bound: Bound, case: Case) -> Iterator[tuple[list[object], list[list[bool]]]]:
    """The events of each chunk, and which rules were active after each of its rows."""
    rows = len(case.table.rows)
    for start in range(0, rows, case.chunk):
        run = bound.run(start, min(start + case.chunk, rows), active=True)
        yield [exactly(event) for event in run.events], run.active.tolist()


def row_by_row(case: Case) -> Iterator[tuple[list[object], list[list[bool]]]]:
    """The same from the interpreter, which gets a message at a time."""
    interpreter = Interpreter(case.machine)
    times_ns = case.table.times_ns.tolist()
    for start in range(0, len(times_ns), case.chunk):
        events, active = [], []
        for row in range(start, min(start + case.chunk, len(times_ns))):
            events += interpreter.update(times_ns[row], case.table.rows[row])
            active.append(list(interpreter.active))
        yield [exactly(event) for event in events], active
