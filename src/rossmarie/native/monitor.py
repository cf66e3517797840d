"""A monitor in C that runs in this process, with the methods and events of the interpreter.

The input is the machine and the C text that a target wrote for it. This module uses only the
functions of `host.c`.
"""

from __future__ import annotations

import sysconfig
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from importlib import resources
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.ir import Batch, ChannelValues, Event, Taken
from rossmarie.native.batches import BatchTable, SampleTable
from rossmarie.native.build import BuildError, build
from rossmarie.native.columns import MachineColumns, fit
from rossmarie.native.events import EventReader
from rossmarie.native.library import NativeLibrary, Pointer
from rossmarie.native.result import RunResult
from rossmarie.native.signatures import declarations, fields_of

_NEVER = 2**63 - 1
_NAN = float("nan")
_TOO_MANY = 2**32 - 1
"""More elements than the list of any input may have. C then reads no elements."""
_BYTES = "unsigned char[]"
_OWN = ("batch.c", "fastcall.c", "fastguard.c", "guarding.c")
_HEADERS = Path(sysconfig.get_paths()["include"])

RowsCall: TypeAlias = Callable[[int, int, "NDArray[np.uint8] | None"], bytes]
"""The call takes start, stop, and memory for the active bits or None, and returns the bytes of the
events.
"""

MOST_FIELDS = 256  # the same as in fastcall.c


@dataclass(frozen=True)
class Mains:
    """The file to compile: one file for a library with functions for Python, and one for a plain
    library.
    """

    plain: str
    for_python: str


_MAINS = Mains("batch.c", "fastcall.c")


def load_native(machine: ir.Machine, files: Mapping[str, str]) -> NativeMonitor:
    """Build the files (`host.c` among them) and return a monitor in its initial state.

    A library in the cache that cannot be loaded is built again. Raises `NoCompilerError`,
    `BuildError`, or `OSError` if the disk is full, or if the library cannot be loaded.
    """
    reader = EventReader(machine)
    declared = declarations(fields_of(machine))
    return NativeMonitor(machine, load_library(_MAINS, files, declared, reader), reader)


def load_library(
    mains: Mains, files: Mapping[str, str], declared: str, reader: EventReader
) -> NativeLibrary:
    """Build the files and load the result. Raises the errors of `load_native`."""
    built = _built(mains, files)
    try:
        return _checked(NativeLibrary(built, declared), reader)
    except OSError:
        return _checked(NativeLibrary(_built(mains, files, rebuild=True), declared), reader)


def _built(mains: Mains, files: Mapping[str, str], *, rebuild: bool = False) -> bytes:
    """The content of the built library. It has functions for Python if Python's headers exist and
    work.
    """
    texts, beside = with_own(files), [name for name in files if name.endswith("_reactor.c")]
    if (_HEADERS / "Python.h").is_file():
        try:
            include = f"-I{_HEADERS}"
            return build(texts, mains.for_python, include, beside=beside, rebuild=rebuild)
        except BuildError:
            pass  # Some systems have the headers without their configuration.
    return build(texts, mains.plain, beside=beside, rebuild=rebuild)


def with_own(files: Mapping[str, str]) -> dict[str, str]:
    """The generated files, and the files of this folder that include them. `batch.c` and
    `fastcall.c` include a monitor, `guarding.c` and `fastguard.c` a monitor with its reactor.
    """
    folder = resources.files(__package__)
    own = {name: folder.joinpath(name).read_text(encoding="utf-8") for name in _OWN}
    return {**files, **own}


def _checked(library: NativeLibrary, reader: EventReader) -> NativeLibrary:
    """The library. Raises `OSError` if the library belongs to another machine."""
    if library.function("host_event_size")() != reader.size:
        raise OSError("the library logs events of another size")
    return library


class NativeMonitor:
    """A monitor. Instants are nanoseconds on one clock, between `ir.EARLIEST_NS` and
    `ir.LATEST_NS`. Every method with an instant raises `ValueError` outside this range.
    """

    def __init__(
        self, machine: ir.Machine, library: NativeLibrary, reader: EventReader, kind: str = "host"
    ) -> None:
        """`kind` is the object that C creates: the monitor alone, or a `guard`, which also has a
        reactor.

        Raises `OSError` if the arithmetic of the library does not follow IEEE 754.
        """
        self._machine = machine
        self.library = library
        self._reader = reader
        self._fields = fields_of(machine)
        made = library.function(f"{kind}_new")()
        if library.is_null(made):
            raise MemoryError
        self.host = library.owned(made, library.function(f"{kind}_free"))
        if fault := library.text_at(library.function("host_fault")(self.host)):
            raise OSError(f"the compiled monitor computes wrongly: {fault}")
        self._run = library.function("host_run")
        self._event_count = library.function("host_event_count")
        self._failed = library.function("host_failed")
        self.active_bytes = (max(1, len(machine.rules)) + 7) // 8
        self._waiting = b""

    def fresh(self) -> NativeMonitor:
        """Another monitor of the same machine in its initial state."""
        return NativeMonitor(self._machine, self.library, self._reader)

    # --- the interface of the interpreter ----------------------------------------------------

    @property
    def active(self) -> tuple[bool, ...]:
        """The rules that are active, by index."""
        bits = self.active_bits
        rules = range(len(self._machine.rules))
        return tuple(bool(bits[rule // 8] >> rule % 8 & 1) for rule in rules)

    @property
    def active_bits(self) -> bytes:
        """The active rules as bits: the bit of rule r is bit `r % 8` of byte `r // 8`."""
        return self.library.bytes_at(self._call("host_active"), self.active_bytes)

    def next_wake(self) -> int | None:
        """The instant in ns at which the caller has to call `advance` if no message comes
        before.
        """
        wake_ns: int = self._call("host_next_wake")
        return None if wake_ns == _NEVER else wake_ns

    def update(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> list[Event]:
        """Process the messages that arrive at one instant, by channel index."""
        if len(messages) == 1:
            (channel,) = messages
            arguments = self._fields_of(channel, messages[channel])
            return self._events_of(at_ns, f"host_update_{channel}", *arguments)
        return self._update_together(at_ns, messages)

    def _fields_of(self, channel: int, values: ChannelValues) -> list[Pointer]:
        """The fields of one message as arguments."""
        carried = self._fields[channel]
        arguments: list[Pointer] = [values.slots.get(slot, _NAN) for slot in carried.slots]
        unknown = self._unknown_lists(channel, values)
        for array in carried.arrays:
            elements = values.arrays.get(array, ())
            arguments.append(self.library.new("double[]", list(elements)))
            if array in carried.counted:
                arguments.append(_TOO_MANY if array in unknown else len(elements))
        return arguments

    def _unknown_lists(self, channel: int, values: ChannelValues) -> set[int]:
        """The columns of the unknown lists in a message. C receives a count above every bound for
        these columns.
        """
        found: set[int] = set()
        for each in self._fields[channel].lists:
            columns = ir.columns_of(self._machine, each)
            if ir.known_count(values, columns, self._machine.lists[each].most) is None:
                found.update(columns)
        return found

    def _update_together(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> list[Event]:
        present = bytearray(max(1, len(self._fields)))
        slots = [_NAN] * max(1, len(self._machine.slots))
        arrays = [self.library.null] * max(1, len(self._machine.arrays))
        counts = [0] * len(arrays)
        for channel, values in messages.items():
            present[channel] = 1
            for slot in self._fields[channel].slots:
                slots[slot] = values.slots.get(slot, _NAN)
            unknown = self._unknown_lists(channel, values)
            for array in self._fields[channel].arrays:
                elements = values.arrays.get(array, ())
                arrays[array] = self.library.new("double[]", list(elements))
                counts[array] = _TOO_MANY if array in unknown else len(elements)
        return self._events_of(
            at_ns,
            "host_step",
            self.library.pointer(_BYTES, present),
            self.library.new("double[]", slots),
            self.library.new("double *[]", arrays),
            self.library.new("size_t[]", counts),
        )

    def advance(self, at_ns: int) -> list[Event]:
        """Let time pass without a message. Timers that are due exactly at this instant fire."""
        return self._events_of(at_ns, "host_advance")

    def reset(self, at_ns: int, rule: int | None = None) -> list[Event]:
        """Reset one latched rule, or all latched rules if `rule` is None, for an operator. Latched
        rules with a false condition are cleared.
        """
        return self._events_of(at_ns, "host_reset", -1 if rule is None else rule)

    # --- fast --------------------------------------------------------------------------------

    def update_call(self, channel: int) -> Callable[..., int]:
        """A function for one message on a channel: `(at_ns, *slots) -> number of new events`. Slots
        are in index order, in the units of the message. The result -1 means that the instant is out
        of range.

        The events wait for `take_events`, which raises `MemoryError` if some were lost for lack of
        memory. If Python's headers exist, the function also raises it. Raises `ValueError` if the
        channel carries arrays.
        """
        carried = self._fields[channel]
        if carried.arrays:
            raise ValueError("a channel with arrays has no fast call")
        if len(carried.slots) <= MOST_FIELDS:
            slots = len(carried.slots)
            if made := self.library.update_function(self.host, channel, slots, self):
                return made
        return partial(self.library.function(f"host_update_{channel}"), self.host)

    def take_events(self) -> list[Event]:
        """The events of the fast calls since the last call of this method.

        If events were lost for lack of memory, raises `MemoryError`, also at all later calls.
        """
        log, self._waiting = self._waiting + self._drain(), b""
        return self._reader.read(log)

    def run(
        self,
        times_ns: NDArray[np.int64],
        columns: Mapping[str, NDArray[np.generic]],
        *,
        active: bool = False,
    ) -> RunResult:
        """Update all channels at every instant of `times_ns` (shape (rows,), in ns) with the fields
        of the row, in the units of the messages. `fit` describes the columns.

        Raises `ColumnError` if the columns do not fit; then nothing has changed.
        """
        return self.bind(times_ns, columns).run(active=active)

    def bind(
        self, times_ns: NDArray[np.int64], columns: Mapping[str, NDArray[np.generic]]
    ) -> BoundColumns:
        """Check columns once, as for `run`, for runs over chunks.

        Raises `ColumnError` if they do not fit.
        """
        return BoundColumns(self, fit(self._machine, times_ns, columns))

    def take(self, batch: Batch, shown: Sequence[int]) -> Taken:
        """Process the updates of a batch, and sample the signals `shown`, which are neither
        constant nor elementwise.

        Raises `ValueError` at an instant out of range, and `MemoryError` if events were lost for
        lack of memory.
        """
        count = len(batch.times_ns)
        table = BatchTable(self.library, batch)
        samples = SampleTable(self.library, count, shown)
        self._waiting += self._drain()
        found, done, is_full = [], 0, True
        while is_full:
            done = self._call("host_take", done, table.pointer, samples.pointer)
            is_full = samples.is_full
            found.append(samples.move_out())
        events = self._reader.read(self._drain())
        if done != count:
            raise ValueError(f"the instant of update {done} is out of range")
        times_ns, values = map(np.concatenate, zip(*found, strict=True))
        return Taken(events, times_ns, values)

    def rows_call(self, table: Pointer, kept: object) -> RowsCall:
        """A function that processes rows of a table. `kept` owns the memory of the table; the
        caller keeps it as well.
        """
        made = self.library.rows_function(self.host, table, (self, kept))
        if made is not None:
            return made

        def rows(start: int, stop: int, room: NDArray[np.uint8] | None) -> bytes:
            bits = self.library.null if room is None else self.library.pointer(_BYTES, room)
            self._waiting += self._drain()
            done = self._run(self.host, start, stop, table, bits)
            if done != stop:
                raise ValueError(f"the instant of row {done} is out of range")
            return self._drain()

        return rows

    def result(self, log: bytes, packed: NDArray[np.uint8] | None) -> RunResult:
        """The results of a run."""
        return RunResult(self._machine, self._reader, log, packed)

    # --- calls -------------------------------------------------------------------------------

    def _call(self, name: str, *arguments: Pointer) -> Pointer:
        return self.library.function(name)(self.host, *arguments)

    def _events_of(self, at_ns: int, name: str, *arguments: Pointer) -> list[Event]:
        ir.require_instant(at_ns)
        self._waiting += self._drain()
        self._call(name, at_ns, *arguments)
        return self._reader.read(self._drain())

    def _drain(self) -> bytes:
        """The bytes of the events since the last call."""
        if self._failed(self.host):
            raise MemoryError("the log of events could not grow: events are lost")
        count = self._event_count(self.host)
        if not count:
            return b""
        log = self.library.bytes_at(self._call("host_events"), count * self._reader.size)
        self._call("host_forget_events")
        return log


class BoundColumns:
    """Columns that a monitor has checked. They must not change while the monitor uses them."""

    def __init__(self, monitor: NativeMonitor, columns: MachineColumns) -> None:
        self._monitor = monitor
        self._rows = len(columns.times_ns)
        library = monitor.library
        fields = [library.pointer("char[]", x) for x in (*columns.slots, *columns.arrays)]
        members = {
            "times": library.pointer("int64_t[]", columns.times_ns),
            "columns": library.new("void *[]", fields or [library.null]),
            "widths": library.new("size_t[]", [array.shape[1] for array in columns.arrays] or [0]),
            "arriving": library.pointer(_BYTES, columns.arriving),
        }
        table = library.new("host_table *", members)
        self._memory = (fields, members, table)
        self._take_rows = monitor.rows_call(table, self._memory)

    def run(self, start: int = 0, stop: int | None = None, *, active: bool = False) -> RunResult:
        """Process the rows from `start` up to, not including, `stop`, or to the end.

        Raises `IndexError` if there are no such rows, `MemoryError` if events were lost.
        """
        end = self._rows if stop is None else stop
        if not 0 <= start <= end <= self._rows:
            raise IndexError(f"no rows from {start} to {end} among {self._rows}")
        packed = None
        if active:
            packed = np.empty((end - start, self._monitor.active_bytes), np.uint8)
        return self._monitor.result(self._take_rows(start, end, packed), packed)
