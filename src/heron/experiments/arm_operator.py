"""The operator of the arm."""

from __future__ import annotations

from collections.abc import Callable

from heron.experiments.summons import Summons
from heron.guard import Guard

_MENDING_NS = 2_000_000_000


class ArmOperator:
    """Repairs the cause of a stop, and resets the rules."""

    period_ns = 100_000_000

    def __init__(self, guard: Guard, mend: Callable[[], None], delay: float) -> None:
        self.summons = Summons(guard, delay)
        self._mend = mend

    def tick(self, now_ns: int) -> None:
        """Look after the arm."""
        presence_ns = self.summons.presence_ns(now_ns)
        if presence_ns == 0:
            self._mend()
        elif presence_ns is not None and presence_ns >= _MENDING_NS:
            self.summons.reset()
