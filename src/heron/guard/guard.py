"""The guard. Each message passes through the core, which determines the active rules and their
consequences, and through the filters, which limit commands, before the next message is handled.

As in the generated nodes, the rules are evaluated once all inputs with a timeout have arrived, or
`PATIENCE_NS` is over. Until then no command passes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence, Set
from functools import lru_cache, partial

from heron.guard.commands import CommandMessages
from heron.guard.intake import FieldReaders, Intake, transforms_in
from heron.guard.model import Guard, Occurrence, unfiltered, waiting
from heron.guard.performing import NEVER, Workshop, require_scalar_fields, servers
from heron.guard.relay import Relay
from heron.messages import Message
from heron.topics import Carrier, InProcess, Topic
from rossmarie.guard import UPDATE_PERIOD_NS, CommandFilter, Core
from rossmarie.ir import (
    Edge,
    FieldBounds,
    Machine,
    Reported,
    TaskCommand,
    TaskCommandKind,
    TaskState,
    Verdict,
)

PERIOD_NS = 2_000_000  # the longest delay of a timer
PATIENCE_NS = 5_000_000_000
_SOON_NS = 20_000_000
"""A wake that is no closer is not put off with each message: planning costs more than a message."""
_IN_FORCE = (TaskState.RUNNING, TaskState.HOLDING)


class InProcessGuard:
    """A rules file on guard. `clock` is the time of the robot, in ns."""

    period_ns = PERIOD_NS

    def __init__(self, machine: Machine, carrier: Carrier, clock: Callable[[], int]) -> None:
        self.machine = machine
        self._clock = clock
        core, readings = _prepared(machine)
        self._core = core.fresh()
        self._intake = Intake(self._core, readings)
        self.is_acting = False
        """True while any task of a rule is in force."""
        self.is_restricting = False
        """True while any command topic is bounded, or taken over by a rule."""
        self.verdicts: list[Verdict] = []
        self.occurrences: list[Occurrence] = []
        self._latched: tuple[str, ...] | None = None
        self._awaited = {used.channel for used in machine.inputs if used.timeout_ns is not None}
        self._first: dict[int, Message] = {}
        self._has_begun = self._is_open = False
        self._wake_ns = self._filters_due_ns = 0
        self._deeds_ns = NEVER
        self.due_ns = 0
        """The instant from which on `tick` has something to do."""
        self._subscribe(carrier)
        self._filters = self._make_filters(carrier)
        self._relays = _make_relays(machine, carrier)
        self._reports: list[tuple[int, bool]] = []
        self._is_following = False
        self._performers = Workshop(
            machine, carrier, self._filters, self._relays, self._report
        ).performers()
        self._rules = {
            task: rule for rule, plan in enumerate(machine.reactions.plans) for task in plan.tasks
        }

    @property
    def active(self) -> tuple[str, ...]:
        """The rules that are active."""
        return self._core.active

    @property
    def servers(self) -> Set[str]:
        """The action servers that it stands in front of."""
        return self._relays.keys()

    @property
    def latched(self) -> tuple[str, ...]:
        """The latched rules that wait for an operator."""
        if self._latched is None:
            self._latched = waiting(self.machine, self.active)
        return self._latched

    @property
    def reported(self) -> Sequence[tuple[int, str]]:
        """Its verdicts in words, with their instants (ns)."""
        return [(verdict.at_ns, self.explain(verdict)) for verdict in self.verdicts]

    def explain(self, verdict: Verdict) -> str:
        """A verdict in words."""
        return self._core.explain(verdict)

    def reset(self) -> None:
        """An operator resets all latched rules."""
        now_ns = self._clock()
        self._follow(now_ns, self._core.reset(now_ns))

    def tick(self, now_ns: int) -> None:
        """Time has passed."""
        if not self._has_begun:
            if now_ns >= PATIENCE_NS:
                self._begin(now_ns)
        elif now_ns >= self._wake_ns:
            self._wake(now_ns)
        if now_ns >= self._filters_due_ns:
            self._update_filters(now_ns)
        turn_ns = self._wake_ns if self._has_begun else PATIENCE_NS
        self.due_ns = min(turn_ns, self._filters_due_ns)

    # --- what comes in -----------------------------------------------------------------------

    def _subscribe(self, carrier: Carrier) -> None:
        frames: dict[Topic, dict[int, Edge]] = {}
        for index, channel in enumerate(self.machine.channels):
            topic = Topic(channel.source, channel.source_type)
            if channel.edge is None:
                carrier.subscribe(topic, self._listener(index))
            else:
                frames.setdefault(topic, {})[index] = channel.edge
        for topic, edges in frames.items():
            carrier.subscribe(topic, self._listener_to_frames(edges))

    def _listener(self, channel: int) -> Callable[[Message], None]:
        clock = self._clock
        read, watch = self._intake.watch(channel)

        def listen(message: Message) -> None:
            has_started = self._is_open and self._has_begun
            if not has_started and not self._takes({channel: message}):
                return
            now_ns = clock()
            wake_ns = watch(now_ns, *read(message))
            if wake_ns is None:
                self._follow(now_ns, self._intake.take())
            elif wake_ns < self._wake_ns or self._wake_ns < now_ns + _SOON_NS:
                self._plan(wake_ns)

        return listen

    def _listener_to_frames(self, edges: Mapping[int, Edge]) -> Callable[[Message], None]:
        """All transforms of one message are seen together."""

        def listen(message: Message) -> None:
            found = transforms_in(message, edges)
            if found and self._takes(found):
                now_ns = self._clock()
                self._follow(now_ns, self._intake.together(now_ns, found))

        return listen

    def _takes(self, messages: Mapping[int, Message]) -> bool:
        """Say whether messages go to the core one by one; the first ones are kept for its
        beginning.
        """
        if not self._is_open:
            self._first.update(messages)
            self._open_when_ready()
        if self._has_begun:
            return True
        if self._is_open:
            self._begin(self._clock())
        return False

    def _open_when_ready(self) -> None:
        """No command passes while an input with a timeout has never arrived (R12)."""
        if self._awaited <= self._first.keys():
            self._is_open = True
            self._core.open()

    def _begin(self, now_ns: int) -> None:
        """With the first messages of all inputs, so that none counts as stale that only starts."""
        self._has_begun = True
        if self._first:
            self._follow(now_ns, self._intake.together(now_ns, self._first))
        else:
            self._follow(now_ns, self._core.advance(now_ns))

    def _wake(self, now_ns: int) -> None:
        """Process a planned turn, unless messages have postponed it since it was planned."""
        wake_ns = self._core_wake_ns()
        if now_ns < min(wake_ns, self._deeds_ns):
            self._plan(wake_ns)
        else:
            self._advance(now_ns)

    def _core_wake_ns(self) -> int:
        wake_ns = self._core.next_wake()
        return NEVER if wake_ns is None else wake_ns

    def _advance(self, now_ns: int) -> None:
        reported = self._core.advance(now_ns)
        for performer in self._performers:
            performer.tick(now_ns)
        self._follow(now_ns, reported)

    def _plan(self, wake_ns: int) -> None:
        """Plan the next turn: the core must wake up at this instant."""
        deeds_ns = self._deeds_ns
        self._wake_ns = min(deeds_ns, wake_ns)
        filters_ns = self._filters_due_ns
        self.due_ns = min(filters_ns, self._wake_ns)

    # --- what follows ------------------------------------------------------------------------

    def _follow(self, now_ns: int, reported: Reported) -> None:
        """Perform the consequences of the reports of the core, at the same instant."""
        self._is_following = True
        self._latched = None
        self._carry_out(now_ns, reported)
        while self._reports:
            task, success = self._reports.pop(0)
            self._carry_out(now_ns, self._core.report(now_ns, task, success=success))
        self._is_following = False
        self.is_acting = any(state in _IN_FORCE for state in self._core.states)
        for command in self._filters.values():
            command.forget()
        self._update_filters(now_ns)
        self._deeds_ns = min((each.due_ns for each in self._performers), default=NEVER)
        self._plan(self._core_wake_ns())

    def _carry_out(self, now_ns: int, reported: Reported) -> None:
        self.verdicts += [event for event in reported.events if isinstance(event, Verdict)]
        for task_command in reported.task_commands:
            self._perform(now_ns, task_command)

    def _perform(self, now_ns: int, task_command: TaskCommand) -> None:
        task = self.machine.reactions.tasks[task_command.task]
        rule = self.machine.rules[self._rules[task_command.task]].name
        action = self.machine.reactions.actions[task.action].name
        self.occurrences.append(Occurrence(now_ns, rule, action, task_command.kind))
        if task_command.kind is TaskCommandKind.START:
            self._performers[task_command.task].start(now_ns)
        else:
            self._performers[task_command.task].stop()

    def _report(self, task: int, success: bool) -> None:
        """A task has ended: at once, or some time after it was started."""
        self._reports.append((task, success))
        if not self._is_following:
            self._follow(self._clock(), Reported([], []))

    # --- commands ----------------------------------------------------------------------------

    def _make_filters(self, carrier: Carrier) -> dict[int, CommandFilter[Message]]:
        filters = {}
        for index, command in enumerate(self.machine.reactions.commands):
            require_scalar_fields(command)
            filters[index] = CommandFilter(
                CommandMessages(command),
                carrier.publisher(Topic(command.topic, command.message_type)),
                self._bounds_on(index),
            )
            source = Topic(unfiltered(command.topic), command.message_type)
            carrier.subscribe(source, self._commanded(filters[index]))
        return filters

    def _bounds_on(self, command: int) -> Callable[[int], tuple[FieldBounds, ...]]:
        return lambda at_ns: self._core.bounds(at_ns, command)

    def _commanded(self, command: CommandFilter[Message]) -> Callable[[Message], None]:
        def receive(message: Message) -> None:
            now_ns = self._clock()
            if self._has_begun and now_ns >= self._wake_ns:
                self._wake(now_ns)
            command.receive(now_ns, message)
            self._note_restriction()

        return receive

    def _update_filters(self, now_ns: int) -> None:
        is_idle = True
        for command in self._filters.values():
            command.update(now_ns)
            is_idle = is_idle and command.is_idle
        self._filters_due_ns = NEVER if is_idle else now_ns + UPDATE_PERIOD_NS
        self._note_restriction()

    def _note_restriction(self) -> None:
        """Witnesses ask at every step: it is noted whenever a filter may have changed."""
        self.is_restricting = any(each.is_restricting for each in self._filters.values())


def _make_relays(machine: Machine, carrier: Carrier) -> dict[str, Relay]:
    relays = {}
    for name in servers(machine):
        relays[name] = Relay(partial(carrier.server, name))
        carrier.serve(unfiltered(name), relays[name])
    return relays


@lru_cache(maxsize=16)
def _prepared(machine: Machine) -> tuple[Core, FieldReaders]:
    """Built and loaded once for all episodes."""
    return Core(machine), FieldReaders(machine)


class InProcessLink:
    """Everything in this process."""

    period_ns = 1_000_000_000

    def carrier(self, clock: Callable[[], int]) -> InProcess:  # noqa: ARG002
        """The carrier between the robot and its programs."""
        return InProcess()

    def guard(self, machine: Machine, carrier: InProcess, clock: Callable[[], int]) -> Guard:
        """The guard that keeps the robot safe by rules."""
        return InProcessGuard(machine, carrier, clock)

    def tick(self, now_ns: int) -> None:
        """Everybody has heard it already."""
