"""The step at hand of a command, on standard error if that is a terminal. The libraries that draw
it are imported only when there is something to draw: most commands are done before.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_PATIENCE_S = 1.0
"""Before that, a reader has not begun to wonder."""


@contextmanager
def reported_progress(what: str) -> Iterator[Callable[[float], None]]:
    """A function to call with the share that is done, from 0 to 1: it moves a bar on standard error
    if that is a terminal.
    """
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        Progress,
        TaskProgressColumn,
        TextColumn,
        TimeRemainingColumn,
    )

    console = Console(stderr=True)
    bar = Progress(
        TextColumn(what),
        BarColumn(),
        TaskProgressColumn(),
        TimeRemainingColumn(),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )
    with bar:
        task = bar.add_task(what, total=1.0)
        yield lambda part: bar.update(task, completed=part)


@contextmanager
def reported_steps(first: str) -> Iterator[Callable[[str], None]]:
    """A function to call with the words for each step: they stand on standard error, if that is a
    terminal, while the whole takes longer than `_PATIENCE_S`.
    """
    if not sys.stderr.isatty():
        yield lambda _: None
        return
    shown = _Steps(first)
    timer = threading.Timer(_PATIENCE_S, shown.draw)
    timer.daemon = True
    timer.start()
    try:
        yield shown.tell
    finally:
        timer.cancel()
        shown.end()


class _Steps:
    """The words for the step at hand, which a timer begins to draw."""

    def __init__(self, first: str) -> None:
        self._lock = threading.Lock()
        self._words = first
        self._update: Callable[[str], None] = lambda _: None
        self._stop: Callable[[], None] | None = lambda: None

    def tell(self, words: str) -> None:
        """The next step begins."""
        with self._lock:
            self._words = words
            self._update(words)

    def draw(self) -> None:
        """Draw from now on, unless the end has come."""
        from rich.console import Console
        from rich.status import Status

        with self._lock:
            if self._stop is not None:
                status = Status(self._words, console=Console(stderr=True))
                status.start()
                self._update, self._stop = status.update, status.stop

    def end(self) -> None:
        """Draw no more."""
        with self._lock:
            if self._stop is not None:
                self._stop()
            self._stop = None
