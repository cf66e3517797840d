"""The current step of a command, on standard error if it is a terminal.

The drawing libraries are imported only for drawing, because most commands end earlier.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_PATIENCE_S = 1.0
"""The time in s after which a user starts to wonder."""


@contextmanager
def reported_progress(what: str) -> Iterator[Callable[[float], None]]:
    """A function that moves a progress bar on standard error, if it is a terminal. Call it with the
    completed share, from 0 to 1.
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
    """A function that shows the words for each step on standard error, if it is a terminal. They
    appear only if the whole takes longer than `_PATIENCE_S`.
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
    """The words for the current step. A timer starts to draw them."""

    def __init__(self, first: str) -> None:
        self._lock = threading.Lock()
        self._words = first
        self._update: Callable[[str], None] = lambda _: None
        self._stop: Callable[[], None] | None = lambda: None

    def tell(self, words: str) -> None:
        """Begin the next step."""
        with self._lock:
            self._words = words
            self._update(words)

    def draw(self) -> None:
        """Draw from now on, unless the work has ended."""
        from rich.console import Console
        from rich.status import Status

        with self._lock:
            if self._stop is not None:
                status = Status(self._words, console=Console(stderr=True))
                status.start()
                self._update, self._stop = status.update, status.stop

    def end(self) -> None:
        """Stop drawing."""
        with self._lock:
            if self._stop is not None:
                self._stop()
            self._stop = None
