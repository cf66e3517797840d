"""An operator who is called when rules have stopped the robot permanently, and who arrives after a
while.
"""

from __future__ import annotations

from heron.guard import Guard


class Summons:
    """`visits` counts the visits of the operator, `delay` seconds after each call."""

    def __init__(self, guard: Guard, delay: float) -> None:
        self._guard = guard
        self._delay_ns = round(delay * 1e9)
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
            if now_ns - self._called_ns < self._delay_ns:
                return None
            self._arrived_ns = now_ns
            self.visits += 1
        return now_ns - self._arrived_ns

    def reset(self) -> None:
        """He resets the rules, and leaves. If one of them is still violated, he is called again."""
        self._guard.reset()
        self._called_ns = self._arrived_ns = None
