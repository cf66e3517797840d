"""The external interface of a guard, in this process or in a ROS node."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from heron.topics import InProcess
from rossmarie.ir import Machine, TaskCommandKind

_UNFILTERED = "unfil_"


@dataclass(frozen=True)
class Occurrence:
    """An action of the guard: a command for a task, and the rule that caused it."""

    at_ns: int
    rule: str
    action: str
    kind: TaskCommandKind


class Guard(Protocol):
    """Rules on guard. It has its turn again and again."""

    @property
    def period_ns(self) -> int:
        """The time between two turns."""

    @property
    def is_acting(self) -> bool:
        """True while any task of a rule is in force."""

    @property
    def is_restricting(self) -> bool:
        """True while any command topic is bounded, or taken over by a rule."""

    @property
    def active(self) -> tuple[str, ...]:
        """The rules that are active."""

    @property
    def latched(self) -> tuple[str, ...]:
        """The latched rules that wait for an operator."""

    @property
    def occurrences(self) -> Sequence[Occurrence]:
        """All actions of the guard."""

    @property
    def reported(self) -> Sequence[tuple[int, str]]:
        """Its verdicts in words, with their instants (ns)."""

    def reset(self) -> None:
        """An operator resets all latched rules."""

    def tick(self, now_ns: int) -> None:
        """Its turn."""


class Link(Protocol):
    """The carrier of messages in an episode, and the place of the guard."""

    def carrier(self, clock: Callable[[], int]) -> InProcess:
        """The carrier between the robot and its programs. `clock` is the time of the robot,
        in ns.
        """

    def guard(self, machine: Machine, carrier: InProcess, clock: Callable[[], int]) -> Guard:
        """The guard that keeps the robot safe by rules."""

    @property
    def period_ns(self) -> int:
        """The time between two turns, each after all other nodes."""

    def tick(self, now_ns: int) -> None:
        """All messages of this instant have been sent."""


def unfiltered(topic: str) -> str:
    """The topic to which programs publish commands that the guard filters, as in the generated
    nodes.
    """
    head, slash, tail = topic.rpartition("/")
    return f"{head}{slash}{_UNFILTERED}{tail}"


def waiting(machine: Machine, active: Sequence[str]) -> tuple[str, ...]:
    """The active rules that wait for an operator."""
    latching = {rule.name for rule in machine.rules if rule.release is None}
    return tuple(name for name in active if name in latching)
