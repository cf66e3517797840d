"""A command topic: each command of a program passes, is bounded, is blocked, or is sent again.

The nodes of ROS do the same (`runtime/ros/filter.h`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Generic, Protocol, TypeVar

from rossmarie.ir import FieldBounds

Message = TypeVar("Message")
Bounds = Sequence[FieldBounds]

UPDATE_PERIOD_NS = 50_000_000
"""The time in ns between two commands of the filter itself, and between two calls of `update`."""

_UNBOUNDED = FieldBounds(1.0, -math.inf, math.inf)
_NEVER = -(10**18)
_TIMEOUT_NS = 500_000_000  # an older command is not sent again


class Commands(Protocol[Message]):
    """The messages of one command topic."""

    def still(self) -> Message:
        """A command in which all numbers are 0."""

    def numbers(self, message: Message, /) -> Sequence[float]:
        """The numbers of a command, in the order of the fields of its topic."""

    def with_numbers(self, message: Message, numbers: Sequence[float], /) -> Message:
        """Another command with these numbers, and with all other data of `message`."""


class CommandFilter(Generic[Message]):
    """The filter of one command topic. `bounds` returns the bounds at an instant. While the bounds
    let every command pass, `bounds` is called again only after `forget`.
    """

    def __init__(
        self,
        commands: Commands[Message],
        publish: Callable[[Message], None],
        bounds: Callable[[int], Bounds],
    ) -> None:
        self._commands = commands
        self._publish = publish
        self._bounds_at = bounds
        self._free: Bounds | None = None
        self._still = commands.still()
        self._latest = self._still
        self._received_ns = self._sent_ns = _NEVER
        self._sent: Bounds = ()
        self._is_taken_over = self._is_blocked = False
        self.is_restricting = False
        """True if the last sent command differs from the command of the program."""

    def receive(self, now_ns: int, message: Message) -> None:
        """Receive a command of a program. While a rule commands, the command is ignored."""
        if self._is_taken_over:
            return
        self._latest, self._received_ns = message, now_ns
        self._pass(now_ns, message)

    @property
    def is_idle(self) -> bool:
        """True if `update` has nothing to do before `forget`: no bounds exist, and the last command
        was sent without bounds.
        """
        return self._free is not None and self._sent is self._free

    def take_over(self, now_ns: int, message: Message) -> None:
        """Receive a command of a rule. It replaces the program's commands until `give_back`."""
        self._is_taken_over = True
        self._latest = message
        self._pass(now_ns, message)

    def forget(self) -> None:
        """Note that rules have changed, so that other bounds may apply."""
        self._free = None

    def give_back(self) -> None:
        """Let the program command again."""
        self._is_taken_over = False
        self._latest = self._still
        self._received_ns = _NEVER

    def pass_once(self, now_ns: int, message: Message) -> None:
        """Send a single command of a rule."""
        self._pass(now_ns, message)

    def update(self, now_ns: int) -> None:
        """Apply the bounds. Call this method whenever bounds may have changed, and regularly."""
        bounds = self._bounds(now_ns)
        if bounds is self._sent:
            return
        was_blocked, self._is_blocked = self._is_blocked, all(map(_is_zero, bounds))
        is_due = now_ns - self._sent_ns >= UPDATE_PERIOD_NS
        if self._is_blocked:
            is_wanted = is_due or not was_blocked
        else:
            is_changed = tuple(bounds) != tuple(self._sent)
            is_wanted = is_changed and self._is_fresh(now_ns) and (is_due or self._tightens(bounds))
        if is_wanted:
            self._pass(now_ns, self._latest)

    def _is_fresh(self, now_ns: int) -> bool:
        return self._is_taken_over or now_ns - self._received_ns < _TIMEOUT_NS

    def _tightens(self, bounds: Bounds) -> bool:
        """Say whether bounds are tighter than at the last sent command, and thus apply at once."""
        return any(
            new.factor < old.factor or new.low > old.low or new.high < old.high
            for new, old in zip(bounds, self._sent, strict=True)
        )

    def _bounds(self, now_ns: int) -> Bounds:
        if self._free is not None:
            return self._free
        bounds = self._bounds_at(now_ns)
        if all(bound == _UNBOUNDED for bound in bounds):
            self._free = bounds
        return bounds

    def _pass(self, now_ns: int, message: Message) -> None:
        bounds = self._bounds(now_ns)
        numbers = self._commands.numbers(message)
        is_finite = all(map(math.isfinite, numbers))
        if is_finite and bounds is self._free:
            passed = message
        else:
            passed = self._commands.with_numbers(
                message,
                [
                    bound.of(number) if is_finite else 0.0
                    for bound, number in zip(bounds, numbers, strict=True)
                ],
            )
        self._publish(passed)
        self._sent, self._sent_ns = bounds, now_ns
        self.is_restricting = self._is_taken_over or (passed is not message and passed != message)


def _is_zero(bound: FieldBounds) -> bool:
    return bound.factor == 0.0 or (bound.low == 0.0 and bound.high == 0.0)
