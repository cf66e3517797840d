"""Workers as processes of this machine."""

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

from dslkit.campaign.workers import EpisodeResult, Work

# Spawn, not fork, because the progress bar in this process has threads.
_CONTEXT = multiprocessing.get_context("spawn")
_LOOK_S = 0.2
"""The time in seconds between two checks of silent processes."""


@dataclass(frozen=True)
class Processes:
    """`count` processes. With a limit, an episode may take at most `limit_s` seconds. A process
    that dies loses only its own episode.
    """

    count: int
    limit_s: float | None

    @staticmethod
    def cores() -> int:
        """The number of processes that can run at a time."""
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 1

    def results(self, work: Work, keys: Sequence[str]) -> Generator[EpisodeResult, None, None]:
        """Yield one result for each key, in the order of completion."""
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
        theirs.close()  # so that this process sees when the other one ends

    def begin(self, key: str) -> None:
        """Start an episode in the process."""
        self._key = key
        self._begun_s: float | None = None
        with suppress(OSError):  # the process has ended, which `result` reports
            self.pipe.send(key)

    def result(self) -> EpisodeResult | None:
        """The result of the episode; None while the episode runs."""
        has_ended = not self.is_alive()  # checked first: the process may send a result and then end
        with suppress(EOFError, OSError):  # the process ended while it sent
            while self.pipe.poll():
                said = self.pipe.recv()
                if isinstance(said, EpisodeResult):
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
        """End the process immediately."""
        self._process.kill()
        self._process.join()
        self.pipe.close()

    def _is_late(self) -> bool:
        # Counted from the start of the episode, because the process itself needs time to start.
        if self._limit_s is None or self._begun_s is None:
            return False
        return time.monotonic() - self._begun_s > self._limit_s

    def _failed(self, why: str) -> EpisodeResult:
        return EpisodeResult(self._key, None, why)


_BEGUN = None
"""The message of a process that has started an episode."""


def _serve(work: Work, pipe: Connection[EpisodeResult | None, str]) -> None:
    """Run the episodes that arrive, until no sender is left."""
    Thread(target=_end_with_parent, daemon=True).start()
    with suppress(EOFError, OSError):
        while True:
            key = pipe.recv()
            pipe.send(_BEGUN)
            try:
                result = EpisodeResult(key, work(key))
            except Exception as error:  # a failed episode is a result; the others continue
                result = EpisodeResult(key, None, f"{type(error).__name__}: {error}")
            pipe.send(result)


def _end_with_parent() -> None:
    """End this process with its parent, whatever ends the campaign."""
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)


@contextmanager
def undisturbed() -> Iterator[None]:
    """Protect new workers from interrupts: an interrupt concerns the campaign, which ends its
    workers. Workers that are started in this context never see the signal, not even during their
    start.
    """
    resource_tracker.ensure_running()  # it would let the signal through again when it starts
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
