"""A child process whose messages are all read and which leaves no processes behind."""

from __future__ import annotations

import ctypes
import fcntl
import json
import os
import select
import signal
import sys
import time
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, NoReturn

Send = Callable[[list[Any]], None]

_LONGEST = 1 << 26
"""Bytes of a message: more than this comes from no check."""
_LOOK_S = 0.1
"""The time after which a silent child is looked after, again and again."""
_END_S = 1.0
_SET_DEATH_SIGNAL, _SET_SUBREAPER = 1, 36


class BrokenOffError(Exception):
    """The child cannot be asked any further; the text says why."""


def messages(work: Callable[[Send], None], patience: float) -> Generator[list[Any], None, None]:
    """Give the messages that `work` sends from a child process.

    Raises `BrokenOffError` when the child has ended, when it is silent for `patience` seconds, and
    when it sends what is no message. Whoever has heard enough closes the iterator: then the child
    and all processes that it has started are killed.
    """
    known = _descendants()
    with _adopting():
        child, reading = _started(work)
        try:
            yield from _messages(child, reading, patience)
        finally:
            os.close(reading)
            child.end()
            _kill_orphans(known)


def _messages(child: _Process, reading: int, patience: float) -> Iterator[list[Any]]:
    last, rest, has_ended = time.monotonic(), bytearray(), False
    while True:
        ready, _, _ = select.select([reading], [], [], 0 if has_ended else _LOOK_S)
        part = os.read(reading, 1 << 16) if ready else b""
        if part:
            rest += part
            if b"\n" in part:
                *lines, rest = rest.split(b"\n")
                yield from map(_message, lines)
                last = time.monotonic()
        elif has_ended:
            raise BrokenOffError(child.cause())
        else:
            has_ended = bool(ready) or child.has_ended()
        if time.monotonic() - last > patience:
            raise BrokenOffError(f"the code made no progress for {patience:g} s")
        if len(rest) > _LONGEST:
            raise BrokenOffError("the code sent an invalid message")


def _message(line: bytearray) -> list[Any]:
    try:
        found = json.loads(line)
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, list) or not found:
        raise BrokenOffError("the code wrote into the report of the check")
    return found


class _Process:
    """A child of this process; `os.waitid` would keep its status, but macOS has none."""

    def __init__(self, number: int) -> None:
        self.number = number
        self._status: int | None = None

    def has_ended(self, options: int = os.WNOHANG) -> bool:
        if self._status is None:
            found, status = os.waitpid(self.number, options)
            self._status = status if found else None
        return self._status is not None

    def end(self) -> None:
        """Kill it, and what has stayed in its group."""
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(self.number, signal.SIGKILL)
        if not self.has_ended():
            os.kill(self.number, signal.SIGKILL)
            self.has_ended(0)

    def cause(self) -> str:
        """The reason why the process, whose files close shortly before its end, has nothing more to
        read.
        """
        limit = time.monotonic() + _END_S
        while not self.has_ended():
            if time.monotonic() > limit:
                return "the code closed the report of the check"
            time.sleep(_LOOK_S / 10)
        code = os.waitstatus_to_exitcode(self._status or 0)
        if code >= 0:
            return f"the code ended the process, with exit code {code}"
        name = signal.Signals(-code).name
        hint = ": perhaps because memory was exhausted" if name == "SIGKILL" else ""
        return f"the process was ended by {name}{hint}"


# --- the child ------------------------------------------------------------------------------------


def _started(work: Callable[[Send], None]) -> tuple[_Process, int]:
    """A child that works, and where its messages can be read."""
    for stream in filter(None, (sys.stdout, sys.stderr)):
        stream.flush()
    reading, writing = os.pipe()
    parent = os.getpid()
    child = os.fork()
    if child == 0:
        _work(work, writing, parent)
    os.close(writing)
    return _Process(child), reading


def _work(work: Callable[[Send], None], writing: int, parent: int) -> NoReturn:
    """Work in a session without a terminal, with no file open but for messages."""
    try:
        os.setsid()
        writing = fcntl.fcntl(writing, fcntl.F_DUPFD, 3)  # who calls us may have closed the first
        nowhere = os.open(os.devnull, os.O_RDWR)
        for number in range(3):
            os.dup2(nowhere, number)
        _close_all_but(writing)
        _system_call(_SET_DEATH_SIGNAL, signal.SIGKILL)
        if os.getppid() == parent:
            work(lambda message: _write(writing, message))
    finally:
        os._exit(0)  # at once: nothing that users' code has left for the end is done


def _close_all_but(kept: int) -> None:
    """Close all files but this one, and the first three."""
    for number in map(int, os.listdir("/dev/fd")):  # noqa: PTH208
        if number > 2 and number != kept:
            with suppress(OSError):
                os.close(number)


def _write(file: int, message: list[Any]) -> None:
    left = json.dumps(message).encode() + b"\n"
    while left:
        left = left[os.write(file, left) :]


# --- its end --------------------------------------------------------------------------------------


@contextmanager
def _adopting() -> Iterator[None]:
    """Within, processes that lose their parent become children of this one."""
    _system_call(_SET_SUBREAPER, 1)
    try:
        yield
    finally:
        _system_call(_SET_SUBREAPER, 0)


def _system_call(option: int, value: int) -> None:
    """`prctl`, where there is one."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(option, value, 0, 0, 0)


def _kill_orphans(known: frozenset[int]) -> None:
    """Kill all children but those that are known; theirs become children of this process then."""
    while left := _descendants() - known:
        known |= left  # each once: what cannot be killed is another user's
        for process in left:
            with suppress(ProcessLookupError, PermissionError, ChildProcessError):
                os.kill(process, signal.SIGKILL)
                os.waitpid(process, 0)


def _descendants() -> frozenset[int]:
    """The children of this process, as far as the system tells."""
    found: set[int] = set()
    for file in Path("/proc/self/task").glob("*/children"):
        with suppress(OSError):
            found.update(map(int, file.read_text().split()))
    return frozenset(found)
