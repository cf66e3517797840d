"""Execution of checked code without side effects and with a time limit.

Python calls an audit hook before it opens a file, makes a connection or starts a process (PEP 578).
In `guarded` the hook refuses such calls from any place; calls of EzSkiROS and of library imports
are allowed. `intercept.py` lets code continue after a refused call.
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
    "builtins.input": "waits for input",
    "builtins.breakpoint": "stops in the debugger",
    "ctypes.dlopen": "loads a library",
    "fcntl.": "talks to a device",
    "sqlite3.connect": "opens a database",
    "tempfile.": "makes a file",
}
_FOR_MODULES = frozenset(
    ("os.listdir", "os.scandir", "os.walk", "os.putenv", "os.unsetenv", "socket.gethostname")
)
"""The events without an effect outside of the check. Modules may raise them during their import."""
_CHANGING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
_WAITING = 10
"""The factor between the time limit on the clock and the limit on the processor."""
_LONGEST_WAITING_S = 50.0  # shorter than the patience of `confinement`
_IMPORTING = "<frozen importlib"
_INTERCEPTING = str(Path(__file__).with_name("intercept.py"))


class Interrupted(BaseException):
    """Ends the checked code. An `except Exception` in it cannot stop this."""


class SideEffectError(Interrupted):
    """The checked code tried to cause a side effect. `deed` describes it."""

    def __init__(self, deed: str) -> None:
        self.deed = deed
        super().__init__(deed)


class CodeTimeOverError(Interrupted):
    """The checked code runs for too long."""


class ProcessEndError(Interrupted):
    """Checked code tried to end its process. No check can continue after that."""


@dataclass(frozen=True)
class Refusal:
    """A skipped action: its description, and the place of the request."""

    deed: str
    span: Span


@dataclass
class Refusals:
    """The refused calls of one run of checked code."""

    is_import: bool
    """True during imports, which may read files."""
    stopped: list[Refusal] = field(default_factory=list)
    """The refusals that may have ended the checked code."""
    replaced: dict[Refusal, None] = field(default_factory=dict)
    """The refusals after which the code continued."""
    files: dict[str, None] = field(default_factory=dict)
    """The files of user code that led to refused calls."""
    half_done: list[object] = field(default_factory=list)
    """The objects whose methods were refused, and whose state is therefore unknown."""

    def go_on(self, count: int) -> None:
        """Let checked code continue without the calls that were refused after the first `count`."""
        self.replaced.update(dict.fromkeys(self.stopped[count:]))
        del self.stopped[count:]

    def refusals(self) -> list[Refusal]:
        """All refusals."""
        return [*self.replaced, *self.stopped]


_guards: list[Refusals] = []


def current() -> Refusals | None:
    """The guard of the running checked code."""
    return _guards[-1] if _guards else None


def _hook(event: str, arguments: tuple[Any, ...]) -> None:
    if _guards and (deed := _DEEDS.get(event) or _DEEDS.get(event.partition(".")[0] + ".")):
        if _guards[-1].is_import and (event in _FOR_MODULES or _reads(event, arguments)):
            return
        _stop(deed, sys._getframe(1))  # noqa: SLF001


def _reads(event: str, arguments: tuple[Any, ...]) -> bool:
    """Say whether an event opens a file that can be read without side effects. Devices have side
    effects.
    """
    if event != "open" or arguments[2] & _CHANGING:
        return False
    return isinstance(arguments[0], int) or _is_plain(arguments[0])


def _is_plain(path: Any) -> bool:
    return os.path.isfile(path) or not os.path.exists(path)  # noqa: PTH110, PTH113


def _stop(deed: str, frame: FrameType | None) -> None:
    """Refuse the action of a frame, if the frame is checked code."""
    if files := list(_files_of_user(frame)):
        _guards[-1].files.update(dict.fromkeys(files))
        _guards[-1].stopped.append(Refusal(deed, session.here()))
        raise SideEffectError(deed)


def _files_of_user(frame: FrameType | None) -> Iterator[str]:
    """The files of the checked code behind a frame; none during an import, or if Python reads
    source for a message.
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
    """Replaces `time.sleep`, because before Python 3.13 it raises no audit event. It returns
    immediately.
    """
    if any(_files_of_user(sys._getframe().f_back)):  # noqa: SLF001
        _guards[-1].replaced.setdefault(Refusal("sleeps", session.here()))
    else:
        _sleep(seconds)


_exit = os._exit


def _guarded_exit(status: int) -> NoReturn:
    """Replaces `os._exit`, because it raises no audit event either."""
    if any(_files_of_user(sys._getframe().f_back)):  # noqa: SLF001
        raise ProcessEndError(f"os._exit({status})")
    _exit(status)


_start = threading.Thread.start


def _guarded_start(thread: threading.Thread) -> None:
    """Start a thread, unless the check no longer watches it."""
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
    """While the context is active, `time.sleep` returns immediately, also in modules that are
    imported.
    """
    before, time.sleep = time.sleep, _guarded_sleep
    try:
        yield
    finally:
        time.sleep = before


@contextmanager
def _guarding_python() -> Iterator[None]:
    """While the context is active, the process cannot be ended. Afterwards Python's recursion limit
    is as before.
    """
    depth = sys.getrecursionlimit()
    before, os._exit = os._exit, _guarded_exit
    try:
        yield
    finally:
        os._exit = before
        sys.setrecursionlimit(depth)


@contextmanager
def guarded(seconds: float, *, is_import: bool = False) -> Iterator[Refusals]:
    """While the context is active, side effects raise `SideEffectError`. Code that takes more than
    `seconds` of processor time is ended by `CodeTimeOverError` (in the main thread, on systems with
    timers).

    Other processes do not count, but there is also a longer limit for code that only waits.
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
    """Install the hook once, because hooks stay as long as Python runs."""
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
        raise CodeTimeOverError

    waiting = min(_WAITING * seconds, _LONGEST_WAITING_S)
    timers = (
        (signal.ITIMER_PROF, signal.SIGPROF, seconds),
        (signal.ITIMER_REAL, signal.SIGALRM, waiting),
    )
    before = [(number, signal.signal(number, end)) for _, number, _ in timers]
    for timer, _, limit in timers:
        # Repeated, because code with `except:` may continue after the first exception.
        signal.setitimer(timer, limit, limit)
    try:
        yield
    finally:
        for timer, _, _ in timers:
            signal.setitimer(timer, 0)
        for number, handler in before:
            signal.signal(number, handler)
