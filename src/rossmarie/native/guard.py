"""A monitor in C with the reactor of its rules, in this process.

The input is the machine and the C text that a target wrote for it. This module uses only the
functions of `host.c` and `guard.c`.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.ir import (
    NEVER_NS,
    ChannelValues,
    Event,
    FieldBounds,
    Reported,
    TaskCommand,
    TaskCommandKind,
    TaskState,
    Wiring,
    require_instant,
)
from rossmarie.native.events import EventReader
from rossmarie.native.library import NativeLibrary
from rossmarie.native.monitor import MOST_FIELDS, Mains, NativeMonitor, load_library
from rossmarie.native.signatures import Fields, declarations, fields_of
from rossmarie.native.steps import (
    DECLARATIONS,
    AllowCall,
    Floats,
    NativeRow,
    StepCall,
    WiringTable,
    packed_note,
    plain_step,
)

_MAINS = Mains("guarding.c", "fastguard.c")
_KINDS = tuple(TaskCommandKind)
_STATES = tuple(TaskState)
_NEVER = 2**63 - 1
_BYTES = "unsigned char[]"

_FUNCTIONS = """
host *guard_new(void);
void guard_free(host *);
void guard_restart(host *);
size_t guard_memory_size(void);
void guard_save(host *, unsigned char *);
void guard_load(host *, unsigned char *, void *, size_t);
size_t guard_task_command_count(host *);
void *guard_task_commands(host *);
void guard_forget_task_commands(host *);
bool guard_has_all_inputs(host *);
void guard_open(host *);
void guard_follow(host *, int64_t);
void guard_report(host *, int64_t, int, bool);
int guard_packed(host *, int, int64_t, double *);
int64_t guard_next_wake(host *);
int guard_task_state(host *, int);
void guard_bounds(host *, int64_t, int, double *);
"""


def load_native_guard(machine: ir.Machine, files: Mapping[str, str]) -> NativeGuard:
    """Build the files (`guard.c` among them) and return a guard in its initial state. Raises the
    errors of `load_native`.
    """
    reader = EventReader(machine)
    declared = declarations(fields_of(machine)) + _FUNCTIONS + DECLARATIONS
    return NativeGuard(machine, load_library(_MAINS, files, declared, reader), reader)


class NativeGuard:
    """A monitor and its reactor. The reactor runs after each call of the monitor, at the same
    instant. Every method with an instant raises `ValueError` outside `ir.EARLIEST_NS` and
    `ir.LATEST_NS`, except `bounds`.
    """

    def __init__(self, machine: ir.Machine, library: NativeLibrary, reader: EventReader) -> None:
        """Raises `OSError` if the arithmetic of the library does not follow IEEE 754."""
        self._machine = machine
        self._reader = reader
        self._monitor = NativeMonitor(machine, library, reader, "guard")
        self.library = library
        self.host = self._monitor.host
        self._next_wake = library.function("guard_next_wake")
        self._fields = [len(command.fields) for command in machine.reactions.commands]
        self._events: list[Event] = []
        self._task_command = _task_command(machine)

    def fresh(self) -> NativeGuard:
        """Another guard of the same machine in its initial state."""
        return NativeGuard(self._machine, self.library, self._reader)

    @property
    def active(self) -> tuple[bool, ...]:
        """The rules that are active, by index."""
        return self._monitor.active

    @property
    def states(self) -> tuple[TaskState, ...]:
        """The state of each task, by index."""
        state = self.library.function("guard_task_state")
        tasks = range(len(self._machine.reactions.tasks))
        return tuple(_STATES[state(self.host, task)] for task in tasks)

    @property
    def has_all_inputs(self) -> bool:
        """True once every input with a timeout has arrived."""
        return bool(self.library.function("guard_has_all_inputs")(self.host))

    @property
    def margins(self) -> tuple[float, ...]:
        """The margins that rules declare, in SI units, in the order of the rules."""
        count = len(ir.margins_of(self._machine))
        room = self.library.new("double[]", count + 1)
        self.library.function("guards_margins")(self.host, 1, room)
        return tuple(room[0:count])

    def open(self) -> None:
        """Let commands pass (R12)."""
        self.library.function("guard_open")(self.host)

    def next_wake(self) -> int | None:
        """The instant in ns at which the caller has to call `advance` if no other call comes
        before.
        """
        wake_ns: int = self._next_wake(self.host)
        return None if wake_ns == _NEVER else wake_ns

    def bounds(self, at_ns: int, command: int) -> tuple[FieldBounds, ...]:
        """The bounds on the fields of a command topic at an instant (R11)."""
        count = self._fields[command]
        room = self.library.new("double[]", 3 * count + 1)
        self.library.function("guard_bounds")(self.host, at_ns, command, room)
        return tuple(FieldBounds(*room[3 * n : 3 * n + 3]) for n in range(count))

    # --- events and time ---------------------------------------------------------------------

    def update(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> None:
        """Process the messages that arrive at one instant, by channel index."""
        self._events += self._monitor.update(at_ns, messages)
        self._follow(at_ns)

    def advance(self, at_ns: int) -> None:
        """Let time pass without a message. Timers that are due exactly at this instant fire."""
        self._events += self._monitor.advance(at_ns)
        self._follow(at_ns)

    def reset(self, at_ns: int, rule: int | None = None) -> None:
        """Reset one latched rule, or all latched rules if `rule` is None, for an operator."""
        self._events += self._monitor.reset(at_ns, rule)
        self._follow(at_ns)

    def report(self, at_ns: int, task: int, *, success: bool) -> None:
        """Report the end of a task that got the command to start. Raises `IndexError` if there is
        no such task.
        """
        if not 0 <= task < len(self._machine.reactions.tasks):
            raise IndexError(f"there is no task {task}")
        require_instant(at_ns)
        self.library.function("guard_report")(self.host, at_ns, task, success)

    def update_call(self, channel: int) -> Callable[..., int]:
        """A function for one message on a channel: `(at_ns, *slots) -> number of new events and
        task commands`. `NativeMonitor.update_call` describes it.
        """
        made = self._monitor.update_call(channel)
        if not isinstance(made, partial):
            return made
        packed, new = self.library.function("guard_packed"), self.library.new
        return lambda at_ns, *slots: packed(self.host, channel, at_ns, new("double[]", [*slots, 0]))

    def watch_call(self, channel: int) -> Callable[..., int | None]:
        """A function for one message on a channel: `(at_ns, *slots, *arrays) -> instant of the next
        advance, or None if there is something to take`.

        Slots and arrays are in index order, in the units of the message. Arrays are NumPy arrays of
        float64 or float32. Raises `ValueError` if the channel carries lists. The function raises
        `ValueError` for an instant out of range.
        """
        carried = fields_of(self._machine)[channel]
        if carried.lists or len(carried.slots) > MOST_FIELDS:
            raise ValueError("a channel with lists has no fast call")
        shape = self.library.new("int[]", self._shape(channel, carried))
        if made := self.library.watch_function(self.host, shape, (self, shape)):
            return made
        return self._plain_watch(channel, carried)

    def _shape(self, channel: int, carried: Fields) -> list[int]:
        machine = self._machine
        first = carried.arrays[0] if carried.arrays else 0
        assert carried.arrays == tuple(range(first, first + len(carried.arrays))), "side by side"
        sizes = (len(machine.channels), len(machine.slots), len(machine.arrays))
        head = [channel, len(carried.slots), len(carried.arrays), first]
        return [*head, *sizes, *carried.slots, 0]

    def _plain_watch(self, channel: int, carried: Fields) -> Callable[..., int | None]:
        """The function of `watch_call` without Python's headers."""
        slots, count = carried.slots, len(carried.slots)

        def watch(at_ns: int, *values: Any) -> int | None:
            numbers = dict(zip(slots, map(float, values[:count]), strict=True))
            arrays = dict(zip(carried.arrays, values[count:], strict=True))
            self.update(at_ns, {channel: ChannelValues(numbers, arrays)})
            if self._events or self.library.function("guard_task_command_count")(self.host):
                return None
            wake_ns = self.next_wake()
            return NEVER_NS if wake_ns is None else wake_ns

        return watch

    def step_call(self, wiring: Wiring) -> StepCall:
        """The fastest step for arrays of the sizes in a wiring."""
        table = self._table(wiring)
        if made := self.library.step_function(self.host, table.pointer, (self, table)):
            return made
        return plain_step(self.library, self.host, table, self._note)

    def allow_call(self, wiring: Wiring) -> AllowCall:
        """A function that returns which of some actions would pass unchanged."""
        library, table = self.library, self._table(wiring)
        call = library.function("guards_allow")

        def allow(actions: Floats) -> NDArray[np.bool_]:
            allowed = np.empty(len(actions), np.bool_)
            seen = library.pointer("double[]", actions)
            call(self.host, 1, table.pointer, seen, len(actions), library.pointer(_BYTES, allowed))
            return allowed

        return allow

    def row(self, count: int) -> NativeRow:
        """A row of `count` guards of the same machine in their initial state."""
        return NativeRow(self.library, count, self._machine, self._table)

    def take_events(self) -> list[Event]:
        """The events since the last call. Task commands stay."""
        events, self._events = self._events, []
        return events + self._monitor.take_events()

    def save(self) -> bytes:
        """The whole state, and the task commands that have not been taken."""
        room = bytearray(self._size)
        self.library.function("guard_save")(self.host, self.library.pointer(_BYTES, room))
        return bytes(room) + self._task_command_log()

    def load(self, saved: bytes) -> None:
        """Restore the state of another guard of the same rules. Raises `ValueError` for the state
        of another program.
        """
        count, left = divmod(len(saved) - self._size, self._task_command.size)
        if count < 0 or left:
            raise ValueError("it was saved by another program")
        memory = self.library.pointer(_BYTES, saved)
        task_commands = self.library.pointer(_BYTES, saved[self._size :])
        self.library.function("guard_load")(self.host, memory, task_commands, count)
        self._events = []

    @property
    def _size(self) -> int:
        return int(self.library.function("guard_memory_size")())

    def restart(self) -> None:
        """Forget everything."""
        self.library.function("guard_restart")(self.host)
        self._events = []

    def _table(self, wiring: Wiring) -> WiringTable:
        channels = len(self._machine.channels)
        return WiringTable(self.library, wiring, channels, max(self._fields, default=0))

    def _note(self, said: int) -> bytes:
        tasks = len(self._machine.reactions.tasks)
        states = self.library.new("unsigned char[]", tasks or 1)
        since_ns = self.library.new("int64_t[]", tasks or 1)
        self.library.function("guard_note")(self.host, states, since_ns)
        bits, margins = self._monitor.active_bits, self.margins
        return packed_note(said, bits, margins, list(states)[:tasks], list(since_ns)[:tasks])

    def take(self) -> Reported:
        """All events and task commands since the last call. If any was lost for lack of memory,
        raises `MemoryError`, also at all later calls.
        """
        return Reported(self.take_events(), self._task_commands())

    def _follow(self, at_ns: int) -> None:
        self.library.function("guard_follow")(self.host, at_ns)

    def _task_commands(self) -> list[TaskCommand]:
        log = self._task_command_log()
        self.library.function("guard_forget_task_commands")(self.host)
        return [
            TaskCommand(
                _KINDS[kind],
                task,
                None if by < 0 else by,
                tuple(pose[1 : 1 + pose[0]] if pose else ()),
            )
            for kind, task, by, *pose in self._task_command.iter_unpack(log)
        ]

    def _task_command_log(self) -> bytes:
        count = self.library.function("guard_task_command_count")(self.host)
        found = self.library.function("guard_task_commands")(self.host)
        return self.library.bytes_at(found, count * self._task_command.size)


def _task_command(machine: ir.Machine) -> struct.Struct:
    """A task command in the format of `guard.c`: kind, task, rule, and a pose if the rules retrace
    any.
    """
    most = max((len(each.readings) for each in machine.reactions.memories), default=0)
    return struct.Struct(f"@4i{most}d" if most else "@3i")
