"""Repetition of an action whenever one of some files has changed."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from pathlib import Path

PERIOD_S = 0.5


def watch(files: Callable[[], Iterable[Path]], do: Callable[[], None]) -> None:
    """Do it now, and each time that a file comes, goes or changes; ends when it is interrupted."""
    seen: object = None
    while True:
        now = state(files())
        if now != seen:
            seen = now
            do()
        time.sleep(PERIOD_S)


def state(files: Iterable[Path]) -> dict[Path, tuple[int, int]]:
    """The marks that tell a file from what it was: when it changed, and its size."""
    found = {}
    for file in files:
        try:
            known = file.stat()
        except OSError:
            continue  # it is gone
        found[file] = (known.st_mtime_ns, known.st_size)
    return found
