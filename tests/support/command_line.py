"""The programs of this project, run by their real `main()` in a process of its own, but cheaply.

To import a program takes Python longer than to run it. Therefore `support.program_server` imports
all of them once, and each run is a fork of that server. It differs from a program that a shell
starts in this alone: modules have been imported already. Tests about imports, about signals and
about terminals start a process by `subprocess`; `tests/support/test_command_line.py` does so for
each command.
"""

from __future__ import annotations

import atexit
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

from support import program_server

TIME_LIMIT_S = 300.0
_AT_THE_START = dict(os.environ)
# A server had read these before it knew of a run.
_READ_AT_THE_START = ("PYTHON", "LANG", "LC_", "LD_", "TZ")


def run(
    program: str | Path,
    *arguments: str | Path,
    folder: Path | None = None,
    variables: Mapping[str, str] | None = None,
    given: str = "",
    timeout: float = TIME_LIMIT_S,
    is_merged: bool = False,
    memory: int | None = None,
) -> subprocess.CompletedProcess[str]:
    """Run an installed program, or a file of Python, in `folder`, with `given` to read.

    Its environment is that of the test with `variables`. If `is_merged`, `stdout` has also what it
    writes to standard error. It has at most `memory` bytes of addresses. A run that takes longer
    than `timeout` seconds is killed with all processes of its group, and raises
    `subprocess.TimeoutExpired`.
    """
    path = Path(sys.executable).with_name(program) if isinstance(program, str) else program
    words = [str(path), *map(str, arguments)]
    request = {
        "arguments": words,
        "folder": str((folder or Path()).absolute()),
        "environment": _environment(variables or {}),
        "memory": memory,
    }
    with _file(json.dumps(request)) as asked, _file(given) as read, _file() as out, _file() as err:
        files = (asked, read, out, out if is_merged else err)
        try:
            code = _run([each.fileno() for each in files], timeout)
        except TimeoutError:
            raise subprocess.TimeoutExpired(words, timeout, _text(out), _text(err)) from None
        return subprocess.CompletedProcess(words, code, _text(out), _text(err))


def _environment(variables: Mapping[str, str]) -> dict[str, str]:
    environment = {**os.environ, **variables}
    for name, _ in _AT_THE_START.items() ^ environment.items():
        if name.startswith(_READ_AT_THE_START):
            raise ValueError(f"{name} is read when Python starts: use subprocess.run")
    return environment


@contextmanager
def _file(text: str = "") -> Iterator[IO[str]]:
    """An open file that has no name, with `text` in it."""
    with tempfile.TemporaryFile("w+", encoding="utf-8") as made:
        made.write(text)
        made.seek(0)
        yield made


def _text(file: IO[str]) -> str:
    """All that was written to a file."""
    file.seek(0)
    return file.read()


# --- servers ---------------------------------------------------------------------------------


class _Server:
    """A running `program_server`, which does one thing at a time."""

    def __init__(self) -> None:
        self._ours, theirs = socket.socketpair()
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, program_server.__file__],
                stdin=theirs.fileno(),
                stdout=subprocess.DEVNULL,
                cwd="/",
                env=_AT_THE_START,
                start_new_session=True,  # the keyboard interrupts who tests, and nobody else
            )

    def run(self, files: list[int], timeout: float) -> int:
        socket.send_fds(self._ours, [b"!"], files)
        child = self._number()
        self._ours.settimeout(timeout)
        try:
            return self._number()
        except BaseException:  # it takes too long, or whoever tests has seen enough
            with suppress(ProcessLookupError):  # it has just ended
                os.killpg(child, signal.SIGKILL)
            self._ours.settimeout(None)
            self._number()
            raise
        finally:
            self._ours.settimeout(None)

    def _number(self) -> int:
        answer = self._ours.recv(program_server.NUMBER.size)
        if not answer:
            raise RuntimeError(f"the server of programs has ended: {self._process.wait()}")
        number: int
        (number,) = program_server.NUMBER.unpack(answer)
        return number

    def is_running(self) -> bool:
        return self._process.poll() is None

    def end(self) -> None:
        self._ours.close()
        self._process.wait()


_idle: list[_Server] = []


def _run(files: list[int], timeout: float) -> int:
    """Run by a server that has nothing else to do: threads that run at once have one each."""
    try:
        server = _idle.pop()
    except IndexError:
        server = _Server()
    try:
        return server.run(files, timeout)
    finally:
        if server.is_running():
            _idle.append(server)
        else:
            server.end()


@atexit.register
def _end_servers() -> None:
    while _idle:
        _idle.pop().end()
