"""Workers that are processes of this machine."""

from __future__ import annotations

import multiprocessing
import os
import signal
import time
from collections import deque
from collections.abc import Generator, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection, wait
from threading import Thread

from dslkit.campaign.workers import Result, Work

# Spawned, not forked: what draws the bar in this process has threads.
_CONTEXT = multiprocessing.get_context("spawn")
_LOOK_S = 0.2
"""The time between two looks at processes that say nothing."""


@dataclass(frozen=True)
class Processes:
    """`count` of them; an episode may take `limit_s` at most, if there is such a limit. One that
    dies takes only its own episode with it.
    """

    count: int
    limit_s: float | None

    @staticmethod
    def cores() -> int:
        """The number of processes that can run at a time."""
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 1

    def results(self, work: Work, keys: Sequence[str]) -> Generator[Result, None, None]:
        """One result for each key, as they come."""
        waiting = deque(keys)
        busy: list[_Process] = []
        idle: list[_Process] = []
        try:
            while waiting or busy:
                while waiting and len(busy) < max(1, self.count):
                    busy.append(idle.pop() if idle else _Process(work, self.limit_s))
                    busy[-1].begin(waiting.popleft())
                wait([process.pipe for process in busy], _LOOK_S)
                for process, result in [(each, each.result()) for each in busy]:
                    if result is not None:
                        busy.remove(process)
                        idle += [process] if process.is_alive() else []
                        yield result
        finally:
            for process in (*busy, *idle):
                process.end()


class _Process:
    """A process that runs one episode after another."""

    def __init__(self, work: Work, limit_s: float | None) -> None:
        self.pipe, theirs = _CONTEXT.Pipe()
        self._limit_s = limit_s
        self._process = _CONTEXT.Process(target=_serve, args=(work, theirs), daemon=True)
        with undisturbed():
            self._process.start()
        theirs.close()  # so that its end is seen here

    def begin(self, key: str) -> None:
        """Give it an episode."""
        self._key = key
        self._begun_s: float | None = None
        with suppress(OSError):  # it has ended, which `result` tells
            self.pipe.send(key)

    def result(self) -> Result | None:
        """The result of the episode; None while the episode runs."""
        has_ended = not self.is_alive()  # asked first: it may say something and end
        with suppress(EOFError, OSError):  # it ended while it spoke
            while self.pipe.poll():
                said = self.pipe.recv()
                if isinstance(said, Result):
                    return said
                self._begun_s = time.monotonic()
        if has_ended:
            self._process.join()
            return self._failed(f"its process ended with exit code {self._process.exitcode}")
        if self._is_late():
            self.end()
            return self._failed(f"took longer than {self._limit_s:g} s")
        return None

    def is_alive(self) -> bool:
        """True while the process can run another episode."""
        return self._process.is_alive()

    def end(self) -> None:
        """End it, whatever it does."""
        self._process.kill()
        self._process.join()
        self.pipe.close()

    def _is_late(self) -> bool:
        # Counted from when the process has the episode: to start takes some time as well.
        if self._limit_s is None or self._begun_s is None:
            return False
        return time.monotonic() - self._begun_s > self._limit_s

    def _failed(self, why: str) -> Result:
        return Result(self._key, None, why)


_BEGUN = None
"""The message of a process that has begun an episode."""


def _serve(work: Work, pipe: Connection[Result | None, str]) -> None:
    """Run the episodes that come, until nobody is there who could send one."""
    Thread(target=_end_with_parent, daemon=True).start()
    with suppress(EOFError, OSError):
        while True:
            key = pipe.recv()
            pipe.send(_BEGUN)
            try:
                result = Result(key, work(key))
            except Exception as error:  # an episode that fails is a result; the others go on
                result = Result(key, None, f"{type(error).__name__}: {error}")
            pipe.send(result)


def _end_with_parent() -> None:
    """Whatever ends the campaign ends its episodes, too."""
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)


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
