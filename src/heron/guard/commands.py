"""A command topic: what comes in on the unfiltered topic goes out on the filtered one, bounded."""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Sequence

from heron import messages
from heron.messages import Message
from heron.topics import Publish
from rossmarie.ir import FieldBounds
from rossmarie.ir.reactions import CommandTopic, FieldPath

Bounds = Sequence[FieldBounds]
_UNBOUNDED = FieldBounds(1.0, -math.inf, math.inf)
_NEVER = -(10**18)
_PERIOD_NS = 50_000_000  # of commands of its own, as of the generated nodes
_TIMEOUT_NS = 500_000_000  # an older command is not sent again


class CommandFilter:
    """The filter of one command topic. `bounds` are those of an instant; while they let everything
    pass, they are asked for again only after `forget`.
    """

    def __init__(
        self, command: CommandTopic, publish: Publish, bounds: Callable[[int], Bounds]
    ) -> None:
        self._paths = [field.path for field in command.fields]
        self._publish = publish
        self._bounds_at = bounds
        self._free: Bounds | None = None
        self._still = messages.new_message(command.message_type)
        self._latest = self._still
        self._received_ns = self._sent_ns = _NEVER
        self._sent: Bounds = ()
        self._is_taken_over = self._is_blocked = False
        self.is_restricting = False
        """True if the last command that was sent is not the one that a program gave."""

    def receive(self, now_ns: int, message: Message) -> None:
        """A command of a program; while a rule commands, nobody hears it."""
        if self._is_taken_over:
            return
        self._latest, self._received_ns = message, now_ns
        self._pass(now_ns, message)

    def take_over(self, now_ns: int, message: Message) -> None:
        """A command of a rule, in the place of the program's until `give_back`."""
        self._is_taken_over = True
        self._latest = message
        self._pass(now_ns, message)

    def forget(self) -> None:
        """Rules have changed: other bounds may lie on the commands."""
        self._free = None

    def give_back(self) -> None:
        """The program commands again."""
        self._is_taken_over = False
        self._latest = self._still
        self._received_ns = _NEVER

    def pass_once(self, now_ns: int, message: Message) -> None:
        """A single command of a rule."""
        self._pass(now_ns, message)

    def update(self, now_ns: int) -> None:
        """To be called whenever bounds may have changed, and regularly."""
        bounds = self._bounds(now_ns)
        if bounds is self._sent:
            return
        was_blocked, self._is_blocked = self._is_blocked, all(map(_is_zero, bounds))
        is_due = now_ns - self._sent_ns >= _PERIOD_NS
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
        """Say whether bounds hold anything back that was let through at last: that cannot wait."""
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
        values = [_get(message, path) for path in self._paths]
        is_finite = all(map(math.isfinite, values))
        if is_finite and bounds is self._free:
            passed = message
        else:
            passed = copy.deepcopy(message)
            for path, bound, value in zip(self._paths, bounds, values, strict=True):
                _set(passed, path, bound.of(value) if is_finite else 0.0)
        self._publish(passed)
        self._sent, self._sent_ns = bounds, now_ns
        self.is_restricting = self._is_taken_over or passed != message


def _is_zero(bound: FieldBounds) -> bool:
    return bound.factor == 0.0 or (bound.low == 0.0 and bound.high == 0.0)


def _parent(message: Message, path: FieldPath) -> Message:
    for part in path[:-1]:
        message = getattr(message, str(part))
    return message


def _get(message: Message, path: FieldPath) -> float:
    return float(getattr(_parent(message, path), str(path[-1])))


def _set(message: Message, path: FieldPath, value: float) -> None:
    setattr(_parent(message, path), str(path[-1]), value)
