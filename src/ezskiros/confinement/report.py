"""The report of a check in a child process, and the proof that it is complete."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from types import CodeType
from typing import Any

from dslkit.diagnostics import Collector, Diagnostic
from dslkit.diagnostics.wire import Receiver, Sender
from dslkit.source import SourceFile, Span
from dslkit.source.call_site import line_span
from dslkit.source.paths import shown
from ezskiros import session
from ezskiros.confinement.errors import BrokenOff, CheckerChanged
from ezskiros.confinement.limits import MEMORY, confine
from ezskiros.confinement.own_modules import Seal
from ezskiros.confinement.process import BrokenOffError, Send, messages
from ezskiros.confinement.unconfined import UnconfinedError

PATIENCE_S = 60.0
"""The time for one step, in seconds. One module, or one path through a method, may take a third of
this time.
"""

Work = Callable[[Collector], Any]
"""Work that puts its findings into the collector, and returns JSON data."""


class RefusedError(Exception):
    """Raised by work that cannot do its task. The text gives the reason to the user."""


class DefectError(Exception):
    """A defect of EzSkiROS in the child. The text is the traceback."""


@dataclass(frozen=True)
class Report:
    """The findings, and the result of the work; None if the work did not complete. `refused` has
    the reason if the work refused its task.

    `unconfined` says why the system cannot confine the work, if it should be confined.
    """

    diagnostics: Sequence[Diagnostic]
    value: Any
    refused: str | None
    unconfined: str | None


def confined(work: Work, patience: float = PATIENCE_S, *, may_act: bool = False) -> Report:
    """Run `work` in a child process, which can have no effect on the world unless it may act.

    If users' code breaks the child, the report still has the earlier findings, and an error if
    something is missing. A child without progress for `patience` seconds is killed.
    """
    mark = os.urandom(16).hex()
    listener = _Listener(mark)
    child = _Child(work, mark, may_act)
    try:
        with closing(messages(child.do, patience)) as heard:
            for message in heard:
                if listener.hears_the_end(message):
                    break
    except BrokenOffError as problem:
        listener.note(BrokenOff(reason=str(problem)).at(listener.place()))
    return listener.report()


class _Listener:
    """Keeps the messages of the child, so that the child cannot change them later."""

    def __init__(self, mark: str) -> None:
        self._mark = mark
        self._receiver = Receiver()
        self._collector = Collector()
        self._count = 0
        self._at: str | None = None
        self._unconfined: str | None = None
        self._refused: str | None = None
        self._value: Any = None

    def hears_the_end(self, message: list[Any]) -> bool:
        """Process a message. Returns True if the report is complete."""
        try:
            return self._hear(*message)
        except (ValueError, TypeError):
            raise BrokenOffError("the code wrote into the report of the check") from None

    def _hear(self, kind: str, *rest: Any) -> bool:
        match kind, rest:
            case (("file" | "finding"), _):
                found = self._receiver.receive([kind, *rest])
                if found is not None:
                    self._count += 1
                    self.note(found)
            case "at", (str(path),):
                self._at = path
            case "unconfined", (str(reason),):
                self._unconfined = reason
            case "raised", (str(reason),):
                raise BrokenOffError(reason)
            case "changed", (str(part), str(path), int(line)):
                self.note(CheckerChanged(part=part).at(line_span(_file(path), line)))
                return True
            case "defect", (str(text),):
                raise DefectError(text)
            case "refused", (self._mark, str(text)):
                self._refused = text
                return True
            case "end", (self._mark, self._count, value):
                self._value = value
                return True
            case _:
                raise ValueError(kind)
        return False

    def note(self, found: Diagnostic) -> None:
        self._collector.add(found)

    def place(self) -> Span:
        """The beginning of the file that the child was processing."""
        return session.NOWHERE if self._at is None else Span(_file(self._at), 0, 0)

    def report(self) -> Report:
        return Report(self._collector.sorted(), self._value, self._refused, self._unconfined)


def _file(path: str) -> SourceFile:
    """A file of the user; an empty text with the name if the file cannot be read."""
    try:
        text = Path(path).read_bytes().decode("utf-8", "replace")
    except (OSError, ValueError):
        text = ""
    return SourceFile(shown(path), text)


@dataclass(frozen=True)
class _Child:
    """The other end, in the child process."""

    work: Work
    mark: str
    may_act: bool

    def do(self, send: Send) -> None:
        """Run the work, and report how it ended."""
        try:
            if not self.may_act:
                sys.dont_write_bytecode = True
                confine()
        except UnconfinedError as problem:
            send(["unconfined", str(problem)])
        seal, sent = Seal(), _Sent(send)
        try:
            with session.following(lambda path: send(["at", path])):
                value = self.work(sent)
            end = ["end", self.mark, sent.count, value]
        except RefusedError as problem:
            end = ["refused", self.mark, str(problem)]
        except MemoryError:
            end = ["raised", f"the code needed more than {MEMORY >> 30} GiB of memory"]
        except (
            Exception
        ):  # exceptions of users' code are findings elsewhere, so this one is a defect of EzSkiROS
            end = ["defect", traceback.format_exc()]
        except BaseException as problem:  # no exception of users' code ends a report early
            end = ["raised", f"`{type(problem).__name__}` was raised"]
        changed = seal.broken()
        send(end if changed is None else ["changed", changed[0], *_place(changed[1])])


def _place(part: object) -> tuple[str, int]:
    """The file and the line of a function. Python does not record them for other objects."""
    code = getattr(part, "__code__", None)
    if not isinstance(code, CodeType):
        return session.NOWHERE.file.path, 1
    return code.co_filename, code.co_firstlineno


class _Sent(Collector):
    """Sends each finding immediately."""

    def __init__(self, send: Send) -> None:
        super().__init__()
        self._sender = Sender(send)
        self.count = 0

    def add(self, diagnostic: Diagnostic) -> None:
        """Keep a finding, and send it if it is new."""
        if diagnostic not in self._found:
            super().add(diagnostic)
            self.count += 1
            self._sender.send(diagnostic)
