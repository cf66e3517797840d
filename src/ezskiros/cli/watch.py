"""Repetition of an action after each change of some files."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from pathlib import Path

PERIOD_S = 0.5


def watch(files: Callable[[], Iterable[Path]], do: Callable[[], None]) -> None:
    """Run the action now, and again after each creation, deletion or change of a file, until an
    interrupt.
    """
    seen: object = None
    while True:
        now = state(files())
        if now != seen:
            seen = now
            do()
        time.sleep(PERIOD_S)


def state(files: Iterable[Path]) -> dict[Path, tuple[int, int]]:
    """The modification time and size of each file, which show a change."""
    found = {}
    for file in files:
        try:
            known = file.stat()
        except OSError:
            continue  # the file was deleted
        found[file] = (known.st_mtime_ns, known.st_size)
    return found
