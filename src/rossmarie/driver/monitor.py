"""A rules file as a running monitor: native where there is a C compiler, interpreted elsewhere."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, Event, Machine
from rossmarie.native import NoCompilerError, load_native
from rossmarie.targets import c99


class Monitor(Protocol):
    """What every monitor does; instants are nanoseconds on one clock.

    The methods that take an instant return what they cause, in order, and raise `ValueError` for
    an instant outside the range of `ir.EARLIEST_NS` to `ir.LATEST_NS`.
    """

    @property
    def active(self) -> tuple[bool, ...]:
        """Which rules are active, by index."""

    def next_wake(self) -> int | None:
        """The instant at which `advance` is wanted if no message comes before."""

    def update(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> list[Event]:
        """The messages that arrive at one instant, by channel index."""

    def advance(self, at_ns: int) -> list[Event]:
        """Time passes without a message."""

    def reset(self, at_ns: int, rule: int | None = None) -> list[Event]:
        """An operator resets one latched rule, or all."""


@dataclass(frozen=True)
class Started:
    """A monitor, its kind (`native` or `interpreter`), and why it is not native."""

    monitor: Monitor
    kind: str
    reason: str | None


def start_monitor(machine: Machine) -> Started:
    """A monitor in its initial state; its verdicts are the same whatever its kind."""
    try:
        return Started(load_native(machine, c99.generate(machine)), "native", None)
    except NoCompilerError as error:
        return Started(Interpreter(machine), "interpreter", str(error))
