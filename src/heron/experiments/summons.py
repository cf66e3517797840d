"""An operator who is called when rules have stopped the robot for good, and comes after a while."""

from __future__ import annotations

from heron.guard import Guard

ARRIVAL_NS = 30_000_000_000


class Summons:
    """`visits` counts how often somebody had to come."""

    def __init__(self, guard: Guard) -> None:
        self._guard = guard
        self._called_ns: int | None = None
        self._arrived_ns: int | None = None
        self.visits = 0

    def presence_ns(self, now_ns: int) -> int | None:
        """For how long the operator has been there; None if he is not. To be asked regularly."""
        if not self._guard.latched:
            self._called_ns = self._arrived_ns = None
            return None
        if self._called_ns is None:
            self._called_ns = now_ns
        if self._arrived_ns is None:
            if now_ns - self._called_ns < ARRIVAL_NS:
                return None
            self._arrived_ns = now_ns
            self.visits += 1
        return now_ns - self._arrived_ns

    def reset(self) -> None:
        """He resets the rules, and leaves. If one of them is still violated, he is called again."""
        self._guard.reset()
        self._called_ns = self._arrived_ns = None
