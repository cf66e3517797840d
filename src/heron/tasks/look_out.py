"""The path ahead of the base in the scan: free or blocked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from heron.goals import LOOK_OUT, Goal, number_in
from heron.messages import Message
from heron.topics import SCAN, Carrier


@dataclass(frozen=True)
class LookOutParameters:
    """Lengths in m, times in s. The path ahead is a strip that begins at the scanner, in the middle
    of the base. It is blocked if at least this number of beams ends there.
    """

    reach: float = 1.05
    half_width: float = 0.4
    beams: int = 5
    free_for: float = 0.5
    """The time without an obstacle after which the path counts as free."""


class LookOut:
    """An action server that waits until the path ahead is free, for at most `seconds`."""

    period_ns = 100_000_000

    def __init__(
        self, carrier: Carrier, parameters: LookOutParameters, clock: Callable[[], int]
    ) -> None:
        self._parameters = parameters
        self._clock = clock
        self._limits: np.ndarray | None = None
        self._blocked_ns = self._until_ns = 0
        self._done: Callable[[bool], None] | None = None
        self.is_blocked = False
        carrier.subscribe(SCAN, self._look)
        carrier.serve(LOOK_OUT, self)

    def send(self, goal: Goal, done: Callable[[bool], None]) -> None:
        """Wait, for so many seconds at most."""
        self._done = done
        self._until_ns = self._clock() + round(number_in(goal, "seconds") * 1e9)

    def cancel(self) -> None:
        """Stop waiting."""
        self._end(is_free=False)

    def tick(self, now_ns: int) -> None:
        """A moment later."""
        if now_ns - self._blocked_ns > self._parameters.free_for * 1e9:
            self._end(is_free=True)
        elif now_ns >= self._until_ns:
            self._end(is_free=False)

    def _look(self, message: Message) -> None:
        if self._limits is None:
            self._limits = self._strip(message)
        count = np.count_nonzero(message.ranges < self._limits)
        self.is_blocked = bool(count >= self._parameters.beams)
        if self.is_blocked:
            self._blocked_ns = self._clock()

    def _strip(self, message: Message) -> np.ndarray:
        """The range (m) at which each beam leaves the strip; 0 for those that look back."""
        found = self._parameters
        angles = message.angle_min + message.angle_increment * np.arange(len(message.ranges))
        ahead = found.reach / np.maximum(np.cos(angles), 1e-9)
        aside = found.half_width / np.maximum(np.abs(np.sin(angles)), 1e-9)
        return np.where(np.cos(angles) > 0, np.minimum(ahead, aside), 0.0)

    def _end(self, *, is_free: bool) -> None:
        done, self._done = self._done, None
        if done is not None:
            done(is_free)
