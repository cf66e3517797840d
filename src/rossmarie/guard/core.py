"""The core of a guard: it decides. Its owner carries messages, and performs its task commands."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import copy

from rossmarie.engines import NamedValues, Value, start_guard
from rossmarie.ir import Event, FieldBounds, Machine, Reported, TaskState, as_instant, event_line


class Core:
    """The monitor and the reactor of a rules file, together. After each message and each step of
    time, the reactor processes the verdicts of the monitor at the same instant (R1).

    Fields, instants and errors are as in `rossmarie.Monitor`. Tasks, command topics and task
    commands are indices in `machine.reactions`. A refused call changes nothing.
    """

    def __init__(self, machine: Machine) -> None:
        self.machine = machine
        started = start_guard(machine)
        self._engine = started.engine
        self.kind = started.kind
        self.reason = started.reason
        self._values = NamedValues(machine)
        self._topics = [channel.topic for channel in machine.channels]

    def fresh(self) -> Core:
        """Another core of the same rules in its initial state. This is cheap."""
        another = copy(self)
        another._engine = self._engine.fresh()  # noqa: SLF001 - of this class
        return another

    @property
    def active(self) -> tuple[str, ...]:
        """The names of the rules that are active."""
        pairs = zip(self.machine.rules, self._engine.active, strict=True)
        return tuple(rule.name for rule, is_active in pairs if is_active)

    @property
    def states(self) -> tuple[TaskState, ...]:
        """The state of each task, by index."""
        return self._engine.states

    @property
    def has_all_inputs(self) -> bool:
        """True once every input with a timeout has arrived."""
        return self._engine.has_all_inputs

    def open(self) -> None:
        """Let commands pass. Before this call, every field of every command is bounded to zero
        (R12).
        """
        self._engine.open()

    def bounds(self, at_ns: int, command: int) -> tuple[FieldBounds, ...]:
        """The bounds on the fields of a command topic at an instant (R11)."""
        return self._engine.bounds(at_ns, command)

    def next_wake(self) -> int | None:
        """The instant in ns at which the caller has to call `advance` if no message comes before;
        None if there is none.
        """
        return self._engine.next_wake()

    def explain(self, event: Event) -> str:
        """An event in words: the rule, the change, and its causes."""
        return event_line(self.machine, event)

    # --- events and time ---------------------------------------------------------------------

    def update(self, at_ns: int, values: Mapping[str, Value]) -> Reported:
        """Process messages: one on each topic with a named field."""
        self._engine.update(as_instant(at_ns), self._values.messages(values))
        return self.take()

    def advance(self, at_ns: int) -> Reported:
        """Let time pass without a message. Timers that are due exactly at this instant fire."""
        self._engine.advance(as_instant(at_ns))
        return self.take()

    def reset(self, at_ns: int, rule: str | None = None) -> Reported:
        """Reset one latched rule, or all latched rules if `rule` is None, for an operator. Latched
        rules with a false condition are cleared.
        """
        names = [each.name for each in self.machine.rules]
        self._engine.reset(as_instant(at_ns), None if rule is None else names.index(rule))
        return self.take()

    def report(self, at_ns: int, task: int, *, success: bool) -> Reported:
        """Report the end of a task that got the command to start. For a task that is not running,
        nothing follows (R6). Raises `IndexError` if there is no such task.
        """
        self._engine.report(as_instant(at_ns), task, success=success)
        return self.take()

    def watch_call(self, topic: str) -> Callable[..., int | None]:
        """The fastest call for one topic: `(at_ns, *scalars, *arrays)`, in the order of the
        machine, with only the fields that rules read. It returns None if events or task commands
        wait for `take`. Otherwise it returns the instant in ns at which the caller has to call
        `advance` if no message comes before (`ir.NEVER_NS`: never).

        Arrays are NumPy arrays of float64 or float32. Raises `ValueError` for a topic with lists
        that rules read; the returned function raises it for an instant out of range.
        """
        return self._engine.watch_call(self._topics.index(topic))

    def take(self) -> Reported:
        """The events and task commands since the last call, from the functions that `watch_call`
        returned.
        """
        return self._engine.take()
