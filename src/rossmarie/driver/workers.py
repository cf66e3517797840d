"""Long queries in parallel, each in a process that can be ended at any moment."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import TypeVar

Query = TypeVar("Query")
Answer = TypeVar("Answer")


def answers(
    ask: Callable[[Query], Answer],
    queries: Sequence[Query],
    on_progress: Callable[[float], None],
) -> Iterator[Answer | None]:
    """The answers in the order of the queries; None if the system killed the process.

    If this run ends early, even by a kill, its worker processes and their open files end, too.
    """
    with _workers() as pool:
        waiting = [pool.submit(_answer, ask, query) for query in queries]
        for count, _ in enumerate(as_completed(waiting), 1):
            on_progress(count / len(waiting))
        yield from map(_result, waiting)


def _result(done: Future[Answer]) -> Answer | None:
    try:
        return done.result()
    except BrokenProcessPool:
        return None


@contextmanager
def _workers() -> Iterator[ProcessPoolExecutor]:
    # other start methods copy the threads that draw progress
    context = multiprocessing.get_context("spawn")
    others = multiprocessing.active_children()
    pool = ProcessPoolExecutor(os.cpu_count(), context, initializer=_begin)
    try:
        yield pool
    except BaseException:
        for worker in multiprocessing.active_children():
            if worker not in others:
                worker.terminate()
        raise
    finally:
        _give_up_writing(pool)
        pool.shutdown(cancel_futures=True)


def _give_up_writing(pool: ProcessPoolExecutor) -> None:
    """Let the pool stop writing. A long query may be half written to a worker that has ended. The
    writer ends only if no process can read. Python closes the reading end itself from 3.11.5 on
    (gh-94777); older versions wait forever.
    """
    if sys.version_info >= (3, 11, 5):
        return  # closing it a second time would fail
    reader = getattr(getattr(pool, "_call_queue", None), "_reader", None)
    if reader is not None:
        reader.close()


def _begin() -> None:
    """Ignore Ctrl-C: the whole run handles an interrupt, and ends its workers. If the run ends
    without doing so, the workers end themselves.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_the_run, daemon=True).start()


def _end_with_the_run() -> None:
    run = multiprocessing.parent_process()
    if run is not None:
        run.join()
        os.kill(os.getpid(), signal.SIGTERM)


def _answer(ask: Callable[[Query], Answer], query: Query) -> Answer:
    signal.signal(signal.SIGTERM, _leave)
    try:
        return ask(query)
    except SystemExit:
        os._exit(1)  # otherwise the pool would continue with its next query
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)


def _leave(*_: object) -> None:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)  # a second interrupt would stop the cleanup
    sys.exit()
