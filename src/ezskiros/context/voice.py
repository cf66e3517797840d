"""The thread that publishes snapshots while the ticking thread is alive.

A monitor treats silence as a stale context, and then the stricter of two rules holds. So this
thread must not continue alone: without a heartbeat of the ticking thread it stops publishing. It
does not publish while the process is stopped, and afterwards only when the ticking thread
continues.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from types import TracebackType

from ezskiros.context.snapshot import Snapshot
from ezskiros.export.write import PERIOD

PATIENCE = 5
"""The number of periods without a heartbeat after which the thread stops publishing."""

Publish = Callable[[Snapshot], object]
"""Sends a snapshot. The function must not block."""


class Voice:
    """Publishes the last snapshot once per period, and each new snapshot immediately. Use it in a
    `with` statement.
    """

    def __init__(
        self,
        publish: Publish,
        *,
        period: float = PERIOD,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._publish, self._period, self._clock = publish, period, clock
        self._last: tuple[Snapshot, float] | None = None
        """The last snapshot with the time of the last heartbeat. Both are replaced at once."""
        self._is_new, self._has_ended = threading.Event(), threading.Event()
        self._thread = threading.Thread(target=self._run, name="skill context", daemon=True)
        self.problem: BaseException | None = None
        """The reason why nothing is published any more; None without a problem."""

    # --- for the ticking thread -------------------------------------------------------------------

    def tell(self, snapshot: Snapshot, alive: float | None = None) -> None:
        """Set the snapshot. This is a heartbeat at the current time, or at the time `alive`."""
        is_new = self._last is None or self._last[0] != snapshot
        self._last = snapshot, self._clock() if alive is None else alive
        if is_new:
            self._is_new.set()

    def live(self, alive: float | None = None) -> None:
        """Record a heartbeat: the last reported skills still run."""
        if self._last is not None:
            self._last = self._last[0], self._clock() if alive is None else alive

    def wait(self, seconds: float, sleep: Callable[[float], object] = time.sleep) -> None:
        """Sleep between two ticks, with heartbeats."""
        end = self._clock() + seconds
        while (left := end - self._clock()) > 0:
            sleep(min(left, self._period))
            self.live()

    # --- the other thread -------------------------------------------------------------------------

    def _run(self) -> None:
        try:
            while not self._has_ended.is_set():
                self._is_new.wait(self._period)
                self._is_new.clear()
                self.speak()
        except Exception as problem:
            # Silence reports the fault of the context; the program that runs the skills can log the
            # problem.
            self.problem = problem

    def speak(self) -> bool:
        """Publish if there is a snapshot and the ticking thread is alive. Returns whether it
        published.
        """
        last = self._last
        if last is None or self._has_ended.is_set():
            return False
        snapshot, alive = last
        if self._clock() - alive > PATIENCE * self._period:
            return False
        self._publish(snapshot)
        return True

    # --- start and end ----------------------------------------------------------------------------

    def begin(self) -> None:
        """Start to publish."""
        self._thread.start()

    def __enter__(self) -> Voice:
        self.begin()
        return self

    def __exit__(
        self,
        _kind: type[BaseException] | None,
        _problem: BaseException | None,
        _trace: TracebackType | None,
    ) -> None:
        self.end()

    def end(self) -> None:
        """Stop publishing for good. A publication in progress is only awaited for a short time."""
        self._has_ended.set()
        self._is_new.set()
        if self._thread.is_alive():
            self._thread.join(PATIENCE * self._period)
