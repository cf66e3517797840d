"""A monitor in Python with the reactor of its rules. Each decision equals the decision of
`native`'s guard.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import copy, deepcopy
from typing import Any

import numpy as np

from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.engines.python_row import PythonRow
from rossmarie.engines.python_steps import PythonSteps
from rossmarie.interpreter import Reactor
from rossmarie.ir import (
    EARLIEST_NS,
    NEVER_NS,
    ChannelValues,
    Event,
    FieldBounds,
    Machine,
    Reported,
    TaskCommand,
    TaskCommandKind,
    TaskState,
    Wiring,
    reactions,
)
from rossmarie.native import AllowCall, StepCall, packed_note


class PythonGuard:
    """A monitor and its reactor. The reactor runs after each call of the monitor, at the same
    instant. Every method with an instant raises `ValueError` outside `ir.EARLIEST_NS` and
    `ir.LATEST_NS`, except `bounds`.
    """

    def __init__(self, machine: Machine, source: str) -> None:
        self._machine = machine
        self._resets = {
            task
            for task, each in enumerate(machine.reactions.tasks)
            if isinstance(each.effect, reactions.Reset)
        }
        timed = [used.channel for used in machine.inputs if used.timeout_ns is not None]
        self._awaited = frozenset(timed)
        self._monitor = PythonMonitor(machine, source)
        self._begin()

    def _begin(self) -> None:
        self._monitor = self._monitor.fresh()
        self._reactor = Reactor(self._machine.reactions)
        self._missing = self._awaited
        self._events: list[Event] = []
        self._task_commands: list[TaskCommand] = []
        self.now_ns = EARLIEST_NS
        """The current instant in ns; before the first call, an instant out of range."""

    def restart(self) -> None:
        """Forget everything. Functions that `update_call` returned before become invalid."""
        self._begin()

    def fresh(self) -> PythonGuard:
        """Another guard of the same machine in its initial state."""
        another = copy(self)
        another._begin()  # noqa: SLF001 - of this class
        return another

    @property
    def active(self) -> tuple[bool, ...]:
        """The rules that are active, by index."""
        return self._monitor.active

    @property
    def states(self) -> tuple[TaskState, ...]:
        """The state of each task, by index."""
        return self._reactor.states

    @property
    def has_all_inputs(self) -> bool:
        """True once every input with a timeout has arrived."""
        return not self._missing

    @property
    def margins(self) -> tuple[float, ...]:
        """The margins that rules declare, in SI units, in the order of the rules."""
        return self._monitor.margins

    def open(self) -> None:
        """Let commands pass (R12)."""
        self._reactor.open()

    def next_wake(self) -> int | None:
        """The instant in ns at which the caller has to call `advance` if no other call comes
        before.
        """
        wakes = (self._monitor.next_wake(), self._reactor.next_wake())
        return min((wake for wake in wakes if wake is not None), default=None)

    def bounds(self, at_ns: int, command: int) -> tuple[FieldBounds, ...]:
        """The bounds on the fields of a command topic at an instant (R11)."""
        return self._reactor.bounds(at_ns, command)

    # --- events and time ---------------------------------------------------------------------

    def update(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> None:
        """Process the messages that arrive at one instant, by channel index."""
        self._events += self._monitor.update(at_ns, messages)
        self._missing -= messages.keys()
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
        self._events += self._monitor.advance(at_ns)
        self._task_commands += self._reactor.report(at_ns, task, success, self._monitor.watches)
        self._follow(at_ns)

    def update_call(self, channel: int) -> Callable[..., int]:
        """A function for one message on a channel: `(at_ns, *slots) -> number of new events and
        task commands`. `PythonMonitor.update_call` describes the arguments.
        """
        take = self._monitor.update_call(channel)

        def call(at_ns: int, *slots: float) -> int:
            before = len(self._events) + len(self._task_commands)
            if take(at_ns, *slots) < 0:
                return -1
            self._missing -= {channel}
            self._events += self._monitor.take_events()
            self._follow(at_ns)
            return len(self._events) + len(self._task_commands) - before

        return call

    def watch_call(self, channel: int) -> Callable[..., int | None]:
        """A function for one message on a channel, like the function of `native`'s guard."""
        inputs = self._machine.inputs
        if any(inputs[each.input].channel == channel for each in self._machine.lists):
            raise ValueError("a channel with lists has no fast call")
        take = self._monitor.message_call(channel)
        count = sum(inputs[slot.input].channel == channel for slot in self._machine.slots)

        def watch(at_ns: int, *values: Any) -> int | None:
            if take(at_ns, *map(float, values[:count]), *values[count:]) < 0:
                raise ValueError(f"an instant of {at_ns} ns is out of range")
            self._missing -= {channel}
            self._events += self._monitor.take_events()
            self._follow(at_ns)
            if self.has_news:
                return None
            wake_ns = self.next_wake()
            return NEVER_NS if wake_ns is None else wake_ns

        return watch

    def row(self, count: int) -> PythonRow:
        """A row of `count` guards of the same machine in their initial state."""
        return PythonRow([self.fresh() for _ in range(count)])

    def take_events(self) -> list[Event]:
        """The events since the last call. Task commands stay."""
        events, self._events = self._events, []
        return events

    def save(self) -> object:
        """The whole state, and the task commands that have not been taken."""
        kept = deepcopy((self._reactor, self._missing, self._task_commands, self.now_ns))
        return (self._monitor.save(), kept)

    def load(self, saved: object) -> None:
        """Restore the state of another guard of the same rules."""
        assert isinstance(saved, tuple)
        monitor, kept = saved
        self._monitor.load(monitor)
        self._reactor, self._missing, self._task_commands, self.now_ns = deepcopy(kept)
        self._events = []

    def step_call(self, wiring: Wiring) -> StepCall:
        """The fastest step for arrays of the sizes in a wiring."""
        return self.steps(wiring).step

    def allow_call(self, wiring: Wiring) -> AllowCall:
        """A function that returns which of some actions would pass unchanged."""
        steps = self.steps(wiring)
        return lambda actions: np.array([steps.allows(each) for each in actions], np.bool_)

    def steps(self, wiring: Wiring) -> PythonSteps:
        """Steps for arrays of the sizes in a wiring."""
        return PythonSteps(self._machine, self, wiring)

    def take(self) -> Reported:
        """All events and task commands since the last call."""
        task_commands, self._task_commands = self._task_commands, []
        return Reported(self.take_events(), task_commands)

    @property
    def has_news(self) -> bool:
        """True if there are events or task commands to take."""
        return bool(self._events or self._task_commands)

    @property
    def begun(self) -> set[int]:
        """The tasks that have started, among the task commands that have not been taken."""
        return {each.task for each in self._task_commands if each.kind is TaskCommandKind.START}

    def note(self, said: int) -> bytes:
        """The facts after a step with these events, in the format of `native`."""
        bits = sum(1 << rule for rule, is_active in enumerate(self.active) if is_active)
        size = (max(1, len(self._machine.rules)) + 7) // 8
        active = bits.to_bytes(size, "little")
        return packed_note(said, active, self.margins, self.states, self._reactor.since_ns)

    def _follow(self, at_ns: int) -> None:
        """Run the reactor, and perform its resets of all latched rules."""
        self.now_ns = at_ns
        while self._commanded(
            self._reactor.react(at_ns, self.active, self._monitor.watches, self._monitor.readings)
        ):
            self._events += self._monitor.reset(at_ns)

    def _commanded(self, task_commands: list[TaskCommand]) -> bool:
        """Say whether any of the task commands is a reset."""
        self._task_commands += task_commands
        return any(
            each.kind is TaskCommandKind.START and each.task in self._resets
            for each in task_commands
        )
