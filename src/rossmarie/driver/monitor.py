"""A rules file as a running monitor: native if there is a C compiler, else in Python."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Collection, Mapping, Sequence
from copy import copy
from os import PathLike
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rossmarie.check.rules.errors import LeftOutRule
from rossmarie.driver.pipeline import compile_file
from rossmarie.driver.python_columns import PythonColumns
from rossmarie.engines import NamedValues, Value, start_monitor
from rossmarie.guard import Declared, Guard
from rossmarie.ir import Category, Event, Machine, as_instant, event_line, without_margins
from rossmarie.native import NativeMonitor, fit


class Run(Protocol):
    """The results of a run over whole columns, computed on demand."""

    @property
    def events(self) -> list[Event]:
        """All events, in order."""

    @property
    def active(self) -> NDArray[np.bool_]:
        """The rules that were active after each row, of shape (rows, rules).

        Raises `ValueError` if the run did not record them.
        """


class Bound(Protocol):
    """Columns that fit a monitor. They must not change while the monitor uses them."""

    def run(self, start: int = 0, stop: int | None = None, *, active: bool = False) -> Run:
        """Process the rows from `start` up to, not including, `stop`, or to the end.

        Raises `IndexError` if there are no such rows, `MemoryError` if events were lost.
        """


class Monitor:
    """The running monitor of a rules file. Names of fields are names of inputs: `speed`,
    `orientation.x`.

    Instants are integers in ns on one clock; values are in the units of the messages. An instant
    that is not an integer raises `TypeError`. An instant outside the years 1896 to 2116
    (`ir.EARLIEST_NS`, `ir.LATEST_NS`) raises `ValueError`. A refused call changes nothing.
    """

    def __init__(self, machine: Machine) -> None:
        """The monitor of a machine. It runs without the machine's margins, which are for guards."""
        self._with_margins = machine
        self.machine = without_margins(machine)
        started = start_monitor(self.machine)
        self._engine = started.engine
        self.kind = started.kind
        self.reason = started.reason
        self._values = NamedValues(machine)

    def fresh(self) -> Monitor:
        """Another monitor of the same rules in its initial state. This is cheap: nothing is
        generated, built or loaded again.
        """
        another = copy(self)
        another._engine = self._engine.fresh()  # noqa: SLF001 - of this class
        return another

    def guard(self, *, observe: Declared, act: Declared) -> Guard:
        """A guard of the same rules in its initial state, to place between a policy and its robot.

        The declarations map the numbers of flat observations and actions to fields. Raises
        `MappingError` if they do not fit the rules. Issues a `RuntimeWarning` with the reason if
        the guard is not native.
        """
        guard = Guard(self._with_margins, observe, act)
        if guard.reason is not None:
            warnings.warn(guard.reason, RuntimeWarning, stacklevel=2)
        return guard

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
        """The instant in ns at which the caller has to call `advance` if no message comes before;
        None if there is none.
        """
        return self._engine.next_wake()

    def update(self, at_ns: int, values: Mapping[str, Value]) -> list[Event]:
        """Process arriving messages: one on each topic with a named field. Unnamed fields are
        unknown.

        For an input whose rules use only its age, give the input's own name, with any value.

        Raises `KeyError` for a name that no rule reads. Raises `TypeError` for a value whose type
        differs from the field's, or for an instant that is not an integer. Raises `OverflowError`
        for an integer beyond all floats, `ValueError` for an instant out of range, and
        `MemoryError` if events were lost for lack of memory.
        """
        return self._engine.update(as_instant(at_ns), self._values.messages(values))

    def advance(self, at_ns: int) -> list[Event]:
        """Let time pass without a message. Timers that are due exactly at this instant fire.

        Raises `TypeError` for an instant that is not an integer, `ValueError` for an instant out of
        range, `MemoryError` if events were lost for lack of memory.
        """
        return self._engine.advance(as_instant(at_ns))

    def reset(self, at_ns: int, rule: str | None = None) -> list[Event]:
        """Reset one latched rule, or all latched rules if `rule` is None, for an operator. Latched
        rules with a false condition are cleared.

        Raises `ValueError` for an unknown rule or an instant out of range, `TypeError` for an
        instant that is not an integer, `MemoryError` if events were lost for lack of memory.
        """
        return self._engine.reset(
            as_instant(at_ns), None if rule is None else self.rules.index(rule)
        )

    def explain(self, event: Event) -> str:
        """An event in words: the rule, the change, and its causes."""
        return event_line(self.machine, event)

    def update_call(self, topic: str) -> Callable[..., int]:
        """The fastest call for one topic: `(at_ns, *scalars) -> number of events, or -1`.

        The scalars are those that rules read, in the order of `fields(topic)`. -1 means that the
        instant is out of range. Numbers are Python's own types. Events wait for `take_events`.
        Raises `ValueError` for an unknown topic, and for a topic with arrays that rules read.
        """
        return self._engine.update_call(self._topic(topic))

    def take_events(self) -> list[Event]:
        """The events since the last call, from the functions that `update_call` returned.

        Raises `MemoryError` if events were lost for lack of memory.
        """
        return self._engine.take_events()

    def fields(self, topic: str) -> tuple[str, ...]:
        """The scalars of a topic that rules read, in the order of `update_call`, without arrays and
        without inputs whose rules use only their age.

        Raises `ValueError` for a topic that no input reads.
        """
        return self._values.scalars(self._topic(topic))

    def run(self, times_ns: NDArray[np.int64], columns: Mapping[str, NDArray[np.generic]]) -> Run:
        """Process whole columns. Each row is a message on every topic with a given column.

        `times_ns` has the shape (rows,), in ns. A column of scalars has the same shape; a column
        of an array has the shape (rows, elements). Every field that rules read needs a column. If
        rules use only the age of an input, its column is optional; without the column, the input
        never arrives. Raises `ColumnError`, a `ValueError`, before processing if the columns do
        not fit, and `MemoryError` if events were lost for lack of memory.
        """
        return self.bind(times_ns, columns).run(active=True)

    def bind(
        self, times_ns: NDArray[np.int64], columns: Mapping[str, NDArray[np.generic]]
    ) -> Bound:
        """Check columns as for `run` once, for runs over chunks: `bound.run(0, 1000)`.

        Raises `ColumnError` if they do not fit.
        """
        if isinstance(self._engine, NativeMonitor):
            return self._engine.bind(times_ns, columns)
        fitting = fit(self.machine, times_ns, columns)
        return PythonColumns(self.machine, self._engine, fitting)

    # --- names -------------------------------------------------------------------------------

    def _topic(self, topic: str) -> int:
        return [channel.topic for channel in self.machine.channels].index(topic)


def load(
    rules: str | PathLike[str],
    *,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
    only: Collection[str] = (),
) -> Monitor:
    """The monitor of a rules file.

    `only` selects rules by category, such as `only=["human"]`. Raises `RulesError` with all errors
    in the rules, or if no rule matches, and `ValueError` for an unknown category. Issues a
    `RuntimeWarning` for each priority that names an excluded rule. If the monitor is not native,
    issues a `RuntimeWarning` with the reason.
    """
    compiled = compile_file(
        Path(rules),
        systems=systems,
        message_folders=message_folders,
        only=[Category(each) for each in only],
    )
    for found in compiled.warnings:
        if found.code == LeftOutRule.code:
            warnings.warn(f"{found.primary.span}: {found.title}", RuntimeWarning, stacklevel=2)
    monitor = Monitor(compiled.with_margins)
    if monitor.reason is not None:
        warnings.warn(monitor.reason, RuntimeWarning, stacklevel=2)
    return monitor
