"""Episodes of all kinds that can go wrong, to be run in other processes."""

from __future__ import annotations

import os
import signal
import sys
import time
from pathlib import Path

from rich.console import Console

from dslkit.campaign import Bar, Journal, Processes, Value, run


def work(key: str) -> Value:
    """Do the work before the colon on the text after it."""
    kind, _, rest = key.partition(":")
    if kind == "raise":
        raise ValueError(rest)
    if kind == "die":
        os.kill(os.getpid(), signal.SIGKILL)
    if kind == "hang":
        time.sleep(600)
    if kind == "slow":
        time.sleep(0.2)
    if kind == "blocked":
        return {"is": signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, ())}
    return {"key_was": key, "number": len(key)}


class SlowToArrive:
    """Work that a process needs two seconds to receive."""

    def __call__(self, key: str) -> Value:
        """The same."""
        return work(key)

    def __reduce__(self) -> tuple[object, ...]:
        return (_arrived, ())


def _arrived() -> SlowToArrive:
    time.sleep(2.0)
    return SlowToArrive()


def main() -> None:
    """A campaign of the keys that are given, or one that takes its time, to be interrupted."""
    keys = sys.argv[2:] or [f"slow:{number}" for number in range(30)]
    with (
        Journal(Path(sys.argv[1]), "test") as journal,
        Bar(Console(), "slow") as bar,
    ):
        run(keys, work, journal, Processes(2, 60.0), bar)


if __name__ == "__main__":
    main()
