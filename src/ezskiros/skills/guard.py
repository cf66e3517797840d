"""Runs code under check so that it does nothing to the world and ends.

Python tells an audit hook before it opens a file, connects or starts a process (PEP 578).
Within `guarded` the hook stops that, wherever it is called from; what our own code and the import
of modules do is let through.
"""

from __future__ import annotations

import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, SupportsIndex

from ezskiros import session

_DEEDS = {
    "open": "opens a file",
    "os.": "changes files or processes",
    "shutil.": "changes files",
    "subprocess.Popen": "starts a program",
    "socket.": "uses the network",
    "urllib.Request": "uses the network",
    "builtins.input": "asks for input",
    "builtins.breakpoint": "stops in the debugger",
    "ctypes.dlopen": "loads a library",
    "sqlite3.connect": "opens a database",
    "tempfile.": "makes a file",
}
_IMPORTING = "<frozen importlib"


class Interrupted(BaseException):
    """Ends the code under check; no `except Exception` of it can stop that."""


class SideEffectError(Interrupted):
    """The code under check was about to do something; `deed` says what."""

    def __init__(self, deed: str) -> None:
        self.deed = deed
        super().__init__(deed)


class TimeOverError(Interrupted):
    """The code under check runs for too long."""


_is_guarded: list[Callable[[str], None]] = []


def _hook(event: str, _arguments: tuple[Any, ...]) -> None:
    if _is_guarded:
        deed = _DEEDS.get(event) or _DEEDS.get(event.partition(".")[0] + ".")
        if deed:
            _stop(deed, sys._getframe(1))  # noqa: SLF001


def _stop(deed: str, frame: FrameType) -> None:
    """Stop what a frame is about to do, if it is code under check."""
    is_main = threading.current_thread() is threading.main_thread()
    if _is_guarded and is_main and _is_of_user(frame):
        _is_guarded[-1](deed)
        raise SideEffectError(deed)


def _is_of_user(frame: FrameType | None) -> bool:
    """Whether code under check is behind it, rather than an import or ourselves."""
    while frame is not None:
        path = frame.f_code.co_filename
        if path.startswith((_IMPORTING, *session.OURS)):
            return False
        if not path.startswith((*session.LIBRARIES, "<frozen")):
            return True
        frame = frame.f_back
    return False


_sleep = time.sleep


def _guarded_sleep(seconds: float | SupportsIndex, /) -> None:
    """Before Python 3.13 no hook is told of sleeping."""
    _stop("sleeps", sys._getframe(1))  # noqa: SLF001
    _sleep(seconds)


_start = threading.Thread.start


def _guarded_start(thread: threading.Thread) -> None:
    """What a thread does is done when nobody looks any more."""
    _stop("starts a thread", sys._getframe(1))  # noqa: SLF001
    _start(thread)


@contextmanager
def _guarding_threads() -> Iterator[None]:
    threading.Thread.start = _guarded_start  # type: ignore[assignment,method-assign]
    try:
        yield
    finally:
        threading.Thread.start = _start  # type: ignore[method-assign]


@contextmanager
def guarding_sleep() -> Iterator[None]:
    """Within, `time.sleep` can be stopped, and modules that are imported keep it so."""
    before, time.sleep = time.sleep, _guarded_sleep
    try:
        yield
    finally:
        time.sleep = before


@contextmanager
def guarded(seconds: float, tell: Callable[[str], None]) -> Iterator[None]:
    """Within, side effects raise `SideEffectError`, after `tell` has been told of them, and code
    that takes longer than `seconds` is ended by `TimeOverError` (in the main thread of systems that
    have timers).
    """
    _install()
    _is_guarded.append(tell)
    try:
        with guarding_sleep(), _guarding_threads(), _limited(seconds):
            yield
    finally:
        _is_guarded.pop()


_installed: list[bool] = []


def _install() -> None:
    """Hooks stay for as long as Python runs: one is enough."""
    if not _installed:
        _installed.append(True)
        sys.addaudithook(_hook)


@contextmanager
def _limited(seconds: float) -> Iterator[None]:
    is_main = threading.current_thread() is threading.main_thread()
    if not is_main or not hasattr(signal, "setitimer"):
        yield
        return

    def end(_signal: int, _frame: FrameType | None) -> None:
        raise TimeOverError

    before = signal.signal(signal.SIGALRM, end)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
