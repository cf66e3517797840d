"""SIGINT (Ctrl-C) and SIGTERM end a command, from its first instant to its last, without a
traceback. The exit code is 128 plus the number of the signal, as in shells.

This module imports little, so that a command can call `end_at_once` before its other imports.
"""

from __future__ import annotations

import _thread
import os
import signal
import sys
import time
from collections.abc import Callable
from types import FrameType

_BASE = 128
_AGAIN_S = 0.02
_came: list[int] = []


def end_at_once() -> None:
    """Let a signal end the process immediately from now on: there is nothing to clean up."""
    _handle(_end)


def raise_interrupts() -> None:
    """Let a signal raise `KeyboardInterrupt` from now on, so that work cleans up as it ends."""
    _handle(_interrupt)
    sys.unraisablehook = _interrupt_again


def ask_to_end() -> Callable[[], bool]:
    """Let signals end nothing from now on. The returned function says whether a signal arrived. Use
    it for work that continues until a user ends it and then prints results.
    """
    asked: list[int] = []
    _handle(lambda number, _: asked.append(number))
    return lambda: bool(asked)


def exit_code() -> int | None:
    """The exit code of a command that a signal has interrupted; None without a signal."""
    return _BASE + _came[0] if _came else None


def _handle(handler: signal._HANDLER) -> None:
    for number in (signal.SIGINT, signal.SIGTERM):
        if signal.getsignal(number) is not signal.SIG_IGN:  # the parent process set it so
            signal.signal(number, handler)


def _end(number: int, _frame: object) -> None:
    os._exit(_BASE + (_came[0] if _came else number))


def _interrupt(number: int, frame: FrameType | None) -> None:
    _came.append(number)
    while frame is not None:
        if (
            frame.f_code is _interrupt_again.__code__
        ):  # an interrupt of this code would be lost as well
            _ask_again()
            return
        frame = frame.f_back
    raise KeyboardInterrupt


def _interrupt_again(lost: sys.UnraisableHookArgs) -> None:
    """Raise a lost interrupt again. If Python cannot raise an interrupt, for example in a callback
    of its import system, Python would print a traceback and continue.
    """
    if _came and issubclass(lost.exc_type, KeyboardInterrupt):
        _ask_again()
    else:
        sys.__unraisablehook__(lost)


def _ask_again() -> None:
    # Not with `threading`: the interrupt may have arrived while the main thread held its locks.
    _thread.start_new_thread(_signal_later, (_thread.get_ident(), _came[0]))


def _signal_later(thread: int, number: int) -> None:
    time.sleep(_AGAIN_S)
    signal.pthread_kill(thread, number)
