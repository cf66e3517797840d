"""Execution of checked code without side effects and with a time limit.

Python calls an audit hook before it opens a file, makes a connection or starts a process (PEP 578).
Within `guarded` the hook refuses such calls from any place; calls of our own code and of library
imports are allowed. `intercept.py` lets code continue after a refused call.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
import tokenize
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import Any, NoReturn, SupportsIndex

from dslkit.source import Span
from ezskiros import session

_DEEDS = {
    "open": "opens a file",
    "os.": "changes files or processes",
    "os.listdir": "reads a folder",
    "os.scandir": "reads a folder",
    "os.walk": "reads a folder",
    "os.putenv": "changes the environment",
    "os.unsetenv": "changes the environment",
    "shutil.": "changes files",
    "subprocess.Popen": "starts a program",
    "socket.": "uses the network",
    "urllib.Request": "uses the network",
    "webbrowser.open": "opens a browser",
    "builtins.input": "asks for input",
    "builtins.breakpoint": "stops in the debugger",
    "ctypes.dlopen": "loads a library",
    "fcntl.": "talks to a device",
    "sqlite3.connect": "opens a database",
    "tempfile.": "makes a file",
}
_FOR_MODULES = frozenset(
    ("os.listdir", "os.scandir", "os.walk", "os.putenv", "os.unsetenv", "socket.gethostname")
)
"""The events that change nothing outside of the check: modules may raise them when they are
imported.
"""
_CHANGING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
_WAITING = 10
"""Code may take so many times as long on the clock as on the processor."""
_LONGEST_WAITING_S = 50.0  # before `confinement` gives the whole check up
_IMPORTING = "<frozen importlib"
_INTERCEPTING = str(Path(__file__).with_name("intercept.py"))


class Interrupted(BaseException):
    """Ends the code under check; no `except Exception` of it can stop that."""


class SideEffectError(Interrupted):
    """The code under check was about to do something; `deed` says what."""

    def __init__(self, deed: str) -> None:
        self.deed = deed
        super().__init__(deed)


class TimeOverError(Interrupted):
    """The code under check runs for too long."""


class ProcessEndError(Interrupted):
    """Checked code tried to end its process, and no check can continue after that."""


@dataclass(frozen=True)
class Refusal:
    """Something that was not done: what, and where it was asked for."""

    deed: str
    span: Span


@dataclass
class Refusals:
    """The calls that one run of code under check was refused."""

    is_import: bool
    """True while modules are imported, which may read files."""
    stopped: list[Refusal] = field(default_factory=list)
    """The refusals that may have ended the code under check."""
    replaced: dict[Refusal, None] = field(default_factory=dict)
    """The refusals that it went on without."""
    files: dict[str, None] = field(default_factory=dict)
    """The files of user code that led to refused calls."""
    half_done: list[object] = field(default_factory=list)
    """The objects whose methods were refused, and whose state is therefore unknown."""

    def go_on(self, count: int) -> None:
        """Let checked code continue without the calls that were refused after the first `count`."""
        self.replaced.update(dict.fromkeys(self.stopped[count:]))
        del self.stopped[count:]

    def refusals(self) -> list[Refusal]:
        """All that was not done."""
        return [*self.replaced, *self.stopped]


_guards: list[Refusals] = []


def current() -> Refusals | None:
    """The guard of the code under check that runs now."""
    return _guards[-1] if _guards else None


def _hook(event: str, arguments: tuple[Any, ...]) -> None:
    if _guards and (deed := _DEEDS.get(event) or _DEEDS.get(event.partition(".")[0] + ".")):
        if _guards[-1].is_import and (event in _FOR_MODULES or _reads(event, arguments)):
            return
        _stop(deed, sys._getframe(1))  # noqa: SLF001


def _reads(event: str, arguments: tuple[Any, ...]) -> bool:
    """Say whether a file is opened that can be read without changing anything; devices cannot."""
    if event != "open" or arguments[2] & _CHANGING:
        return False
    return isinstance(arguments[0], int) or _is_plain(arguments[0])


def _is_plain(path: Any) -> bool:
    return os.path.isfile(path) or not os.path.exists(path)  # noqa: PTH110, PTH113


def _stop(deed: str, frame: FrameType | None) -> None:
    """Stop what a frame is about to do, if it is code under check."""
    if files := list(_files_of_user(frame)):
        _guards[-1].files.update(dict.fromkeys(files))
        _guards[-1].stopped.append(Refusal(deed, session.here()))
        raise SideEffectError(deed)


def _files_of_user(frame: FrameType | None) -> Iterator[str]:
    """The files of the code under check that is behind a frame; none if an import is, or Python
    reads source for a message.
    """
    if not _guards or threading.current_thread() is not threading.main_thread():
        return
    while frame is not None:
        path = frame.f_code.co_filename
        is_ours = path.startswith(session.OURS) and path != _INTERCEPTING
        if is_ours or path.startswith(_IMPORTING) or path == tokenize.__file__:
            return
        if session.is_of_user(path):
            yield path
        frame = frame.f_back


_sleep = time.sleep


def _guarded_sleep(seconds: float | SupportsIndex, /) -> None:
    """Before Python 3.13 no hook is told of sleeping. Nothing comes of it: all goes on at once."""
    if any(_files_of_user(sys._getframe().f_back)):  # noqa: SLF001
        _guards[-1].replaced.setdefault(Refusal("sleeps", session.here()))
    else:
        _sleep(seconds)


_exit = os._exit


def _guarded_exit(status: int) -> NoReturn:
    """No hook is told of the end of the process either."""
    if any(_files_of_user(sys._getframe().f_back)):  # noqa: SLF001
        raise ProcessEndError(f"os._exit({status})")
    _exit(status)


_start = threading.Thread.start


def _guarded_start(thread: threading.Thread) -> None:
    """Start a thread, unless nobody would look any more at what it does."""
    _stop("starts a thread", sys._getframe().f_back)  # noqa: SLF001
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
def _guarding_python() -> Iterator[None]:
    """Within, the process cannot be ended; afterwards Python recurses as deep as before."""
    depth = sys.getrecursionlimit()
    before, os._exit = os._exit, _guarded_exit
    try:
        yield
    finally:
        os._exit = before
        sys.setrecursionlimit(depth)


@contextmanager
def guarded(seconds: float, *, is_import: bool = False) -> Iterator[Refusals]:
    """Within, side effects raise `SideEffectError`, and code that takes more than `seconds` of the
    processor is ended by `TimeOverError` (in the main thread of systems that have timers).

    What else runs on the machine does not count, but code that only waits does not go on for ever.
    """
    _install()
    guard = Refusals(is_import)
    _guards.append(guard)
    try:
        with guarding_sleep(), _guarding_threads(), _guarding_python(), _limited(seconds):
            yield guard
    finally:
        _guards.pop()


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

    waiting = min(_WAITING * seconds, _LONGEST_WAITING_S)
    timers = (
        (signal.ITIMER_PROF, signal.SIGPROF, seconds),
        (signal.ITIMER_REAL, signal.SIGALRM, waiting),
    )
    before = [(number, signal.signal(number, end)) for _, number, _ in timers]
    for timer, _, limit in timers:
        # Again and again: code with `except:` may go on after the first time.
        signal.setitimer(timer, limit, limit)
    try:
        yield
    finally:
        for timer, _, _ in timers:
            signal.setitimer(timer, 0)
        for number, handler in before:
            signal.signal(number, handler)
