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
"""The most bytes of a message. No check sends more."""
_LOOK_S = 0.1
"""The seconds between two checks of a silent child."""
_END_S = 1.0
_SET_DEATH_SIGNAL, _SET_SUBREAPER = 1, 36


class BrokenOffError(Exception):
    """The child can no longer answer. The text gives the reason."""


def messages(work: Callable[[Send], None], patience: float) -> Generator[list[Any], None, None]:
    """Yield the messages that `work` sends from a child process.

    Raises `BrokenOffError` if the child has ended, is silent for `patience` seconds, or sends an
    invalid message. Closing the iterator kills the child and all processes that it has started.
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
    """A child of this process. `os.waitid` would keep its status, but macOS does not have it."""

    def __init__(self, number: int) -> None:
        self.number = number
        self._status: int | None = None

    def has_ended(self, options: int = os.WNOHANG) -> bool:
        if self._status is None:
            found, status = os.waitpid(self.number, options)
            self._status = status if found else None
        return self._status is not None

    def end(self) -> None:
        """Kill the process and the remaining processes of its group."""
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(self.number, signal.SIGKILL)
        if not self.has_ended():
            os.kill(self.number, signal.SIGKILL)
            self.has_ended(0)

    def cause(self) -> str:
        """The reason why the process sends no more data. Its files close shortly before it ends."""
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
    """A child that runs the work, and the file descriptor of its messages."""
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
    """Run the work in a session without a terminal. The only open file is the one for messages."""
    try:
        os.setsid()
        writing = fcntl.fcntl(
            writing, fcntl.F_DUPFD, 3
        )  # the caller may have closed the first files
        nowhere = os.open(os.devnull, os.O_RDWR)
        for number in range(3):
            os.dup2(nowhere, number)
        _close_all_but(writing)
        _system_call(_SET_DEATH_SIGNAL, signal.SIGKILL)
        if os.getppid() == parent:
            work(lambda message: _write(writing, message))
    finally:
        os._exit(0)  # immediately: no exit handler of users' code runs


def _close_all_but(kept: int) -> None:
    """Close all files except this one and the first three."""
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
    """While the context is active, processes that lose their parent become children of this
    process.
    """
    _system_call(_SET_SUBREAPER, 1)
    try:
        yield
    finally:
        _system_call(_SET_SUBREAPER, 0)


def _system_call(option: int, value: int) -> None:
    """Call `prctl`, if the system has it."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(option, value, 0, 0, 0)


def _kill_orphans(known: frozenset[int]) -> None:
    """Kill all unknown children. Their own children then become children of this process."""
    while left := _descendants() - known:
        known |= left  # each only once: a process that survives belongs to another user
        for process in left:
            with suppress(ProcessLookupError, PermissionError, ChildProcessError):
                os.kill(process, signal.SIGKILL)
                os.waitpid(process, 0)


def _descendants() -> frozenset[int]:
    """The children of this process, as far as the system reports them."""
    found: set[int] = set()
    for file in Path("/proc/self/task").glob("*/children"):
        with suppress(OSError):
            found.update(map(int, file.read_text().split()))
    return frozenset(found)
