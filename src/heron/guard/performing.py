"""The execution of the tasks of rules by this guard. Limits and scales need no execution, and the
core resets itself.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Protocol

from heron import messages
from heron.goals import Goal
from heron.guard.relay import Relay
from heron.messages import Message
from heron.topics import Carrier, NodeParameter, Topic
from heron.topics import Publish as Publisher
from rossmarie.guard import CommandFilter
from rossmarie.ir import Machine
from rossmarie.ir.reactions import (
    Call,
    CancelGoal,
    CommandTopic,
    Diagnose,
    Effect,
    Hook,
    Interrupted,
    Limit,
    Log,
    Publish,
    Reset,
    Retrace,
    Scale,
    SendGoal,
    SetParameter,
    SwitchControllers,
)

NEVER = 2**62
"""Later than everything."""
Report = Callable[[bool], None]


class UnsupportedEffectError(ValueError):
    """The rules need an action that this guard cannot perform."""


class Performer(Protocol):
    """The performer of one task. `due_ns` is when `tick` has something to do."""

    due_ns: int

    def start(self, now_ns: int, /) -> None:
        """The task starts."""

    def stop(self) -> None:
        """The task is over, or given up."""

    def tick(self, now_ns: int, /) -> None:
        """Time has passed."""


@dataclass
class Nothing:
    """The performer of a task that needs no deed: its bounds or its verdicts say all."""

    due_ns: int = NEVER

    def start(self, now_ns: int) -> None:
        """The task starts."""

    def stop(self) -> None:
        """The task is over, or given up."""

    def tick(self, now_ns: int) -> None:
        """Time has passed."""


@dataclass
class Once:
    """Something that is done at the start of a task, and has no end."""

    do: Callable[[int], None]
    due_ns: int = NEVER

    def start(self, now_ns: int) -> None:
        """The task starts."""
        self.do(now_ns)

    def stop(self) -> None:
        """The task is over, or given up."""

    def tick(self, now_ns: int) -> None:
        """Time has passed."""


@dataclass
class Repeated:
    """Something that is done again and again until `end`."""

    do: Callable[[int], None]
    end: Callable[[], None]
    period_ns: int
    due_ns: int = NEVER

    def start(self, now_ns: int) -> None:
        """The task starts."""
        self.do(now_ns)
        self.due_ns = now_ns + self.period_ns

    def stop(self) -> None:
        """The task is over, or given up."""
        if self.due_ns != NEVER:
            self.end()
        self.due_ns = NEVER

    def tick(self, now_ns: int) -> None:
        """Time has passed."""
        if now_ns >= self.due_ns:
            self.start(now_ns)


@dataclass
class TemporaryParameter:
    """A parameter with a temporary value while a task holds it."""

    parameter: Callable[[], NodeParameter]
    value: float
    report: Report
    due_ns: int = NEVER
    _kept: float | None = None

    def start(self, _: int) -> None:
        """The task starts."""
        self._kept = self.parameter().get()
        self.parameter().set(self.value)
        self.report(True)

    def stop(self) -> None:
        """The task is over, or given up."""
        if self._kept is not None:
            self.parameter().set(self._kept)
        self._kept = None

    def tick(self, now_ns: int) -> None:
        """Time has passed."""


@dataclass
class Sending:
    """A goal that replaces a client's goal; without a goal, the client's goal is cancelled
    (`cancel`).
    """

    relay: Relay
    goal: Goal | None
    is_resent: bool
    report: Report
    due_ns: int = NEVER
    _is_holding: bool = False
    _is_running: bool = False

    def start(self, _: int) -> None:
        """The task starts."""
        self._is_holding = True
        self.relay.take()
        if self.goal is None:
            self.report(True)
            return
        self._is_running = True
        self.relay.send_own(self.goal, self._end)

    def stop(self) -> None:
        """The task is over, or given up."""
        if self._is_running:
            self._is_running = False
            self.relay.cancel_own()
        if self._is_holding:
            self._is_holding = False
            self.relay.give_back(is_resent=self.is_resent)

    def tick(self, now_ns: int) -> None:
        """Time has passed."""

    def _end(self, is_reached: bool) -> None:
        if self._is_running:
            self._is_running = False
            self.report(is_reached)


@dataclass(frozen=True)
class Workshop:
    """The parts with which performers are made."""

    machine: Machine
    carrier: Carrier
    filters: Mapping[int, CommandFilter[Message]]
    relays: Mapping[str, Relay]
    report: Callable[[int, bool], None]

    def performers(self) -> list[Performer]:
        """One for each task. Raises `UnsupportedEffectError`."""
        tasks = self.machine.reactions.tasks
        return [self._performer(index, task.effect) for index, task in enumerate(tasks)]

    def _performer(self, task: int, effect: Effect) -> Performer:
        report = partial(self.report, task)
        match effect:
            case Publish(command=None):
                topic = Topic(effect.topic, effect.message_type)
                return _publication(effect, self.carrier.publisher(topic))
            case Publish():
                assert effect.command is not None
                return _command(effect, self.filters[effect.command])
            case SetParameter(value=float() | int() as value):
                name = f"{effect.node}.{effect.parameter}"
                return TemporaryParameter(
                    lambda: self.carrier.parameter(name), float(value), report
                )
            case SendGoal():
                goal = {".".join(map(str, each.path)): each.value for each in effect.assignments}
                return Sending(self.relays[effect.server], goal, _resends(effect), report)
            case CancelGoal(confirmation=None):
                return Sending(self.relays[effect.server], None, _resends(effect), report)
            case Limit() | Scale() | Log() | Diagnose() | Reset():
                return Nothing()
            case (
                SetParameter() | CancelGoal() | Call() | SwitchControllers() | Hook() | Retrace()
            ):  # fmt: skip
                kind = type(effect).__name__
                raise UnsupportedEffectError(f"`{kind}` is not performed here")


def servers(machine: Machine) -> set[str]:
    """The action servers that tasks need."""
    effects = (task.effect for task in machine.reactions.tasks)
    return {effect.server for effect in effects if isinstance(effect, SendGoal | CancelGoal)}


def _resends(effect: SendGoal | CancelGoal) -> bool:
    return effect.interrupted is Interrupted.RESEND


def _publication(effect: Publish, publish: Publisher) -> Performer:
    message = message_of(effect)
    if effect.period_ns is None:
        return Once(lambda _: publish(message))
    return Repeated(lambda _: publish(message), lambda: None, effect.period_ns)


def _command(effect: Publish, command: CommandFilter[Message]) -> Performer:
    message = message_of(effect)
    if effect.period_ns is None:
        return Once(lambda now_ns: command.pass_once(now_ns, message))
    return Repeated(
        lambda now_ns: command.take_over(now_ns, message), command.give_back, effect.period_ns
    )


def message_of(effect: Publish) -> Message:
    """The message that an action publishes. Raises `UnsupportedEffectError`."""
    message = messages.new_message(effect.message_type)
    for assignment in effect.assignments:
        *parents, last = assignment.path
        if isinstance(assignment.value, tuple) or any(isinstance(part, int) for part in parents):
            raise UnsupportedEffectError(f"arrays of {effect.topic} are not published here")
        place = message
        for part in parents:
            place = getattr(place, str(part))
        setattr(place, str(last), assignment.value)
    return message


def require_scalar_fields(command: CommandTopic) -> None:
    """Raises `UnsupportedEffectError` for a command with arrays."""
    for field in command.fields:
        if field.is_array or any(isinstance(part, int) for part in field.path):
            raise UnsupportedEffectError(f"arrays of {command.topic} are not bounded here")
