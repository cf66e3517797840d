"""Rules in a closed loop: the same outside messages arrive repeatedly, and the messages that the
rules publish arrive at the rules' own inputs.

The monitor is the interpreter, and its reactor decides which messages are published. Every action
ends at once, with success or with failure. Each message takes a moment to arrive.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from rossmarie.analysis.published import values_of
from rossmarie.analysis.witness import Sending
from rossmarie.interpreter import Interpreter, Reactor, TaskState
from rossmarie.ir import (
    ChannelValues,
    FieldBounds,
    InputState,
    Machine,
    Path,
    TaskCommand,
    TaskCommandKind,
    TruthValue,
)
from rossmarie.ir.reactions import Publish, timeout_ns

_TRANSIT_NS = 10_000_000
_STEP_NS = 1_000_000
_MOST_EVENTS = 4000


@dataclass(frozen=True)
class Outside:
    """The messages from outside, by channel, and the time between them. On the channels in `once`,
    one message arrives. On the channels in `given_up`, messages end with the first message of a
    rule.
    """

    messages: Mapping[int, ChannelValues]
    period_ns: int
    once: frozenset[int]
    given_up: frozenset[int]


@dataclass
class Loop:
    """Some rules of a machine, alone with their messages. `part` is the part of the machine that
    the rules depend on, with these rules in this order.

    With `is_closed`, the messages that the rules publish arrive. Otherwise only messages from
    outside arrive.
    """

    machine: Machine
    part: Machine
    rules: Sequence[int]
    outside: Outside
    is_closed: bool
    ends_well: bool
    sent: list[Sending] = field(default_factory=list)
    starts: dict[int, list[int]] = field(default_factory=dict)
    has_gap: bool = False
    """True if an input that had arrived became stale."""

    def __post_init__(self) -> None:
        self._monitor = Interpreter(self.part)
        self._reactor = Reactor(self.machine.reactions)
        self._reactor.open()
        self._watches = [TruthValue.TRUE] * len(self.machine.watches)
        self._was_active = (False,) * len(self.rules)
        self._under_way: dict[int, tuple[int, ChannelValues]] = {}
        self._due: dict[int, int] = {}
        self._sent_by_rules: set[int] = set()
        topics = {channel.topic: index for index, channel in enumerate(self.machine.channels)}
        self._channels = {
            task: topics[effect.topic]
            for rule in self.rules
            for task in self.machine.reactions.plans[rule].tasks
            if isinstance(effect := self.machine.reactions.tasks[task].effect, Publish)
            and effect.topic in topics
        }
        self.starts = {rule: [] for rule in self.rules}

    def run(self, until_ns: int, times: int) -> int | None:
        """Run until each rule has become active the given number of times. Returns this instant in
        ns, or None if the rules do not reach the number in time.
        """
        for at_ns in self._instants(until_ns):
            if all(len(starts) >= times for starts in self.starts.values()):
                return at_ns
        return None

    def _instants(self, until_ns: int) -> Iterator[int]:
        """Advance from event to event, and yield the instant of each event."""
        outside_ns = 0
        for _ in range(_MOST_EVENTS):
            wakes = [self._monitor.next_wake(), self._reactor.next_wake()]
            known = [each for each in wakes if each is not None]
            at_ns = min([outside_ns, *self._under_way, *self._due.values(), *known])
            if at_ns > until_ns:
                return
            if at_ns == outside_ns:
                self._send_outside(at_ns)
                outside_ns += self.outside.period_ns
            elif at_ns in self._under_way:
                channel, values = self._under_way.pop(at_ns)
                self._deliver(at_ns, {channel: values})
            else:
                self._monitor.advance(at_ns)
                self._publish_due(at_ns)
            self._react(at_ns)
            yield at_ns

    # --- messages ----------------------------------------------------------------------------

    def _send_outside(self, at_ns: int) -> None:
        messages = {
            channel: values
            for channel, values in self.outside.messages.items()
            if (at_ns == 0 or channel not in self.outside.once) and not self._is_taken(channel)
        }
        self._deliver(at_ns, messages)

    def _is_taken(self, channel: int) -> bool:
        """Say whether messages that rules publish at a rate replace other messages: the topic of
        the channel passes through the filter.
        """
        if channel in self._sent_by_rules and channel in self.outside.given_up:
            return True
        return self.is_closed and any(
            self._channels.get(task) == channel
            and isinstance(effect := self.machine.reactions.tasks[task].effect, Publish)
            and effect.command is not None
            and self._reactor.states[task] is TaskState.HOLDING
            for task in self._due
        )

    def _deliver(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> None:
        if messages:
            self._monitor.update(at_ns, messages)
            self.sent.append(Sending(at_ns, messages))
        else:
            self._monitor.advance(at_ns)

    def _publish(self, at_ns: int, task: int) -> None:
        effect = self.machine.reactions.tasks[task].effect
        assert isinstance(effect, Publish)
        if effect.period_ns is not None:
            self._due[task] = at_ns + effect.period_ns
        if not self.is_closed or task not in self._channels:
            return
        channel = self._channels[task]
        arrives_ns = at_ns + _TRANSIT_NS
        while arrives_ns in self._under_way or self._is_outside(arrives_ns):
            arrives_ns += _STEP_NS
        self._sent_by_rules.add(channel)
        self._under_way[arrives_ns] = (channel, self._filtered(at_ns, effect, task, channel))

    def _filtered(self, at_ns: int, effect: Publish, task: int, channel: int) -> ChannelValues:
        """The message as it leaves the filter, if its topic passes through the filter (R11)."""
        values = values_of(self.machine, task, channel)
        if effect.command is None:
            return values
        fields = self.machine.reactions.commands[effect.command].fields
        lying = self._reactor.bounds(at_ns, effect.command)
        paths: list[Path] = [each.path for each in fields]
        bounds = dict(zip(paths, lying, strict=True))
        slots = {
            index: _bounded(bounds, self.machine.slots[index].path, value)
            for index, value in values.slots.items()
        }
        arrays = {
            index: [_bounded(bounds, self.machine.arrays[index].path, each) for each in elements]
            for index, elements in values.arrays.items()
        }
        return ChannelValues(slots, arrays)

    def _is_outside(self, at_ns: int) -> bool:
        """Say whether messages from outside arrive at an instant that the other messages do not
        use.
        """
        period_ns = self.outside.period_ns
        return period_ns > 2 * _STEP_NS and at_ns % period_ns == 0

    def _publish_due(self, at_ns: int) -> None:
        for task, due_ns in list(self._due.items()):
            if self._reactor.states[task] is not TaskState.HOLDING:
                del self._due[task]
            elif due_ns <= at_ns:
                self._publish(at_ns, task)

    # --- rules -------------------------------------------------------------------------------

    def _react(self, at_ns: int) -> None:
        active = self._monitor.active
        self.has_gap |= InputState.EXPIRED in self._monitor.input_states
        for rule, is_active, was_active in zip(self.rules, active, self._was_active, strict=True):
            if is_active and not was_active:
                self.starts[rule].append(at_ns)
        self._was_active = active
        everywhere = [False] * len(self.machine.rules)
        for rule, is_active in zip(self.rules, active, strict=True):
            everywhere[rule] = is_active
        task_commands = self._reactor.react(at_ns, everywhere, self._watches)
        while task_commands:
            following: list[TaskCommand] = []
            for command in task_commands:
                if command.kind is TaskCommandKind.START:
                    following += self._start(at_ns, command.task)
            task_commands = following

    def _start(self, at_ns: int, task: int) -> list[TaskCommand]:
        """Perform a task that starts: the task publishes, or ends at once."""
        effect = self.machine.reactions.tasks[task].effect
        if isinstance(effect, Publish):
            self._publish(at_ns, task)
        if timeout_ns(effect) is None:
            return []
        return self._reactor.report(at_ns, task, self.ends_well, self._watches)


def _bounded(bounds: Mapping[Path, FieldBounds], path: Path, value: float) -> float:
    """A number after the filter has bounded it. An element has the bounds of its array."""
    lying = bounds.get(path) or bounds.get(path[:-1])
    return value if lying is None else lying.of(value)
