"""Real-time pacing: each reading is published when it is due."""

from __future__ import annotations

import time

_LATEST_NS = 40_000_000


class Pace:
    """Instants at intervals of `period_ns`. Delays of up to 40 ms are caught up. After a longer
    delay, time continues from there, so no steps follow too fast.
    """

    def __init__(self, period_ns: int) -> None:
        self._period_ns = period_ns
        self._due_ns = time.monotonic_ns()

    def wait(self) -> None:
        """Wait for the next instant."""
        self._due_ns += self._period_ns
        early_ns = self._due_ns - time.monotonic_ns()
        if early_ns > 0:
            time.sleep(early_ns * 1e-9)
        elif early_ns < -_LATEST_NS:
            self._due_ns -= early_ns
