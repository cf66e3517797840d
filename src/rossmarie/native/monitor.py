"""A monitor in C that runs in this process: the same methods and events as the interpreter.

Takes the machine and the C text that a target wrote for it. Of the text only the functions of
`host.c` are known here, not what is behind them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.ir import ChannelValues, Event
from rossmarie.native.build import build
from rossmarie.native.columns import (
    ColumnOrder,
    PackedMessages,
    RunResult,
    as_column,
    as_instants,
    check_packed,
    contiguous,
)
from rossmarie.native.events import EventReader
from rossmarie.native.library import Library, Pointer
from rossmarie.native.signatures import declarations, fields_of

_NEVER = 2**63 - 1
_NAN = float("nan")


def load_native(machine: ir.Machine, files: Mapping[str, str]) -> NativeMonitor:
    """Build the files (`host.c` among them) and give a monitor that has seen nothing.

    A library in the cache that cannot be loaded is built again. Raises `NoCompilerError`,
    `BuildError`, or `OSError` if the cache cannot be written.
    """
    declared = declarations(fields_of(machine))
    reader = EventReader(machine)
    try:
        library = _checked(Library(build(files, "host.c"), declared), reader)
    except OSError:
        library = _checked(Library(build(files, "host.c", rebuild=True), declared), reader)
    return NativeMonitor(machine, library, reader)


def _checked(library: Library, reader: EventReader) -> Library:
    """Raises `OSError` if the library is of another machine."""
    if library.function("host_event_size")() != reader.size:
        raise OSError("the library logs events of another size")
    return library


class NativeMonitor:
    """A monitor. Instants are nanoseconds on one clock, between `ir.EARLIEST_NS` and
    `ir.LATEST_NS`; every method that takes one raises `ValueError` outside that range.
    """

    def __init__(self, machine: ir.Machine, library: Library, reader: EventReader) -> None:
        self._machine = machine
        self._library = library
        self._reader = reader
        self._fields = fields_of(machine)
        self._order = ColumnOrder(machine)
        made = library.function("host_new")()
        if library.is_null(made):
            raise MemoryError
        self._host = library.owned(made, library.function("host_free"))
        self._active_bytes = (max(1, len(machine.rules)) + 7) // 8
        self._waiting = b""

    # --- as the interpreter ------------------------------------------------------------------

    @property
    def active(self) -> tuple[bool, ...]:
        """Which rules are active, by index."""
        bits = self._library.bytes_at(self._call("host_active"), self._active_bytes)
        rules = range(len(self._machine.rules))
        return tuple(bool(bits[rule // 8] >> rule % 8 & 1) for rule in rules)

    def next_wake(self) -> int | None:
        """The instant at which `advance` is wanted if no message comes before."""
        wake_ns: int = self._call("host_next_wake")
        return None if wake_ns == _NEVER else wake_ns

    def update(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> list[Event]:
        """The messages that arrive at one instant, by channel index."""
        present = bytearray(max(1, len(self._fields)))
        slots = [_NAN] * max(1, len(self._machine.slots))
        arrays = [self._library.null] * max(1, len(self._machine.arrays))
        counts = [0] * len(arrays)
        for channel, values in messages.items():
            present[channel] = 1
            for slot in self._fields[channel].slots:
                slots[slot] = values.slots.get(slot, _NAN)
            for array in self._fields[channel].arrays:
                elements = values.arrays.get(array, ())
                arrays[array] = self._library.new("double[]", list(elements))
                counts[array] = len(elements)
        return self._events_of(
            at_ns,
            "host_step",
            self._library.pointer("unsigned char[]", present),
            self._library.new("double[]", slots),
            self._library.new("double *[]", arrays),
            self._library.new("size_t[]", counts),
        )

    def advance(self, at_ns: int) -> list[Event]:
        """Time passes without a message; timers due at this very instant fire as well."""
        return self._events_of(at_ns, "host_advance")

    def reset(self, at_ns: int, rule: int | None = None) -> list[Event]:
        """An operator resets one latched rule, or all: those with a false condition clear."""
        return self._events_of(at_ns, "host_reset", -1 if rule is None else rule)

    # --- fast --------------------------------------------------------------------------------

    def update_call(self, channel: int) -> Callable[..., int]:
        """A function `(at_ns, *slots) -> number of new events` for one message on a channel, with
        its slots in index order, in the units of the message. -1: the instant is out of range.

        The events wait for `take_events`. Raises `ValueError` if the channel carries arrays.
        """
        if self._fields[channel].arrays:
            raise ValueError("a channel with arrays has no fast call")
        return partial(self._library.function(f"host_update_{channel}"), self._host)

    def take_events(self) -> list[Event]:
        """The events of the fast calls since the last time."""
        log, self._waiting = self._waiting + self._drain(), b""
        return self._reader.read(log)

    def run(
        self,
        times_ns: NDArray[np.int64],
        columns: Mapping[str, NDArray[np.generic]],
        *,
        active: bool = False,
    ) -> RunResult:
        """Update all channels at every instant of `times_ns` (shape (rows,)) with the scalars of
        that row, in the units of the messages; see `columns` for their names.

        Raises `ColumnError` if the columns do not fit, `ValueError` if an instant is out of range:
        rows before it have been taken in.
        """
        instants = as_instants(times_ns)
        rows = len(instants)
        kept = [
            self._library.pointer("char[]", as_column(name, slot.kind, columns[name], rows))
            for name, slot in zip(self._order.of(columns), self._machine.slots, strict=True)
        ]
        packed = np.empty((rows, self._active_bytes), np.uint8) if active else None
        self._waiting += self._drain()
        done = self._call(
            "host_run",
            rows,
            self._library.pointer("int64_t[]", instants),
            self._library.new("void *[]", kept or [self._library.null]),
            self._library.null
            if packed is None
            else self._library.pointer("unsigned char[]", packed),
        )
        _require_all(done, instants)
        return RunResult(self._machine, self._reader, self._drain(), packed)

    def run_events(self, messages: PackedMessages) -> RunResult:
        """Take in messages of all channels, one after the other.

        Raises `ColumnError` if their parts do not fit, `ValueError` if an instant is out of range:
        messages before it have been taken in.
        """
        ready = contiguous(messages)
        check_packed(self._machine, ready)
        self._waiting += self._drain()
        done = self._call(
            "host_run_events",
            len(ready.times_ns),
            self._library.pointer("int64_t[]", ready.times_ns),
            self._library.pointer("int32_t[]", ready.channels),
            self._library.pointer("double[]", ready.slots),
            self._library.pointer("double[]", ready.elements),
            self._library.pointer("size_t[]", ready.counts),
        )
        _require_all(done, ready.times_ns)
        return RunResult(self._machine, self._reader, self._drain(), None)

    # --- calls -------------------------------------------------------------------------------

    def _call(self, name: str, *arguments: Pointer) -> Pointer:
        return self._library.function(name)(self._host, *arguments)

    def _events_of(self, at_ns: int, name: str, *arguments: Pointer) -> list[Event]:
        if not ir.EARLIEST_NS < at_ns < ir.LATEST_NS:
            raise ValueError(f"an instant of {at_ns} ns is out of range")
        self._waiting += self._drain()
        self._call(name, at_ns, *arguments)
        return self._reader.read(self._drain())

    def _drain(self) -> bytes:
        """The bytes of the events that were logged since the last time."""
        count = self._call("host_event_count")
        if not count:
            return b""
        if self._call("host_failed"):
            raise MemoryError("the log of events could not grow")
        log = self._library.bytes_at(self._call("host_events"), count * self._reader.size)
        self._call("host_forget_events")
        return log


def _require_all(done: int, times_ns: NDArray[np.int64]) -> None:
    if done != len(times_ns):
        raise ValueError(f"an instant of {times_ns[done]} ns is out of range")
