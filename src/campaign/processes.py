"""Workers that are processes of this machine."""

from __future__ import annotations

import concurrent.futures
import multiprocessing
import os
import signal
from collections.abc import Generator, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import resource_tracker

from pebble import ProcessExpired, ProcessPool

from campaign.workers import Result, Value, Work


@dataclass(frozen=True)
class Processes:
    """`count` of them; an episode may take `limit_s` at most, if there is such a limit. One that
    dies takes only its own episode with it.
    """

    count: int
    limit_s: float | None

    @staticmethod
    def cores() -> int:
        """How many there can be at a time."""
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 1

    def results(self, work: Work, keys: Sequence[str]) -> Generator[Result, None, None]:
        """One result for each key, as they come."""
        # Spawned, not forked: what draws the bar in this process has threads.
        context = multiprocessing.get_context("spawn")
        pool = ProcessPool(min(self.count, len(keys)) or 1, context=context)
        try:
            with undisturbed():
                waiting: dict[concurrent.futures.Future[Value], str] = {
                    pool.schedule(work, args=[key], timeout=self.limit_s): key for key in keys
                }
            for future in concurrent.futures.as_completed(waiting):
                yield self._result(waiting[future], future)
        finally:
            pool.stop()  # type: ignore[no-untyped-call]
            pool.join()

    def _result(self, key: str, future: concurrent.futures.Future[Value]) -> Result:
        try:
            return Result(key, future.result())
        except concurrent.futures.TimeoutError:  # not that of Python 3.10
            return Result(key, None, f"took longer than {self.limit_s:g} s")
        except ProcessExpired as expired:
            return Result(key, None, f"its process ended with exit code {expired.exitcode}")
        except Exception as error:
            return Result(key, None, f"{type(error).__name__}: {error}")


@contextmanager
def undisturbed() -> Iterator[None]:
    """Whoever interrupts means the campaign, which ends its workers: those that are started within
    this do not hear of it, not even before they have begun.
    """
    resource_tracker.ensure_running()  # it would let the signal through again when it starts
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
