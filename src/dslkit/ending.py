"""The end of a command: exit codes, interrupts, broken output pipes and defects of a tool."""

from __future__ import annotations

import errno
import os
import signal
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

import typer

from dslkit import garbage, signals, streams
from dslkit.writing import reason

if TYPE_CHECKING:  # needed only for a missing module
    from dslkit.extras import Extras

INTERNAL_ERROR = 70
"""The exit code for a defect of the tool (sysexits: EX_SOFTWARE)."""

INTERRUPTED = 128 + signal.SIGINT
"""The exit code of an interrupted run."""

_UNHEARD = 141  # the exit code of a program that SIGPIPE ends: 128 + 13
_OUTPUT_FAILURES = frozenset((errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EFBIG, errno.EBADF))


@dataclass(frozen=True)
class Ending:
    """The end of one command.

    `tool` is the program, `subject` the work of its users, and `internal_code` the code of the
    diagnostic for defects of the program. `extras` gives the extras of the distribution.
    `complain` prints one line on standard error.
    """

    tool: str
    subject: str
    internal_code: str
    extras: Callable[[], Extras]
    complain: Callable[[str], None]

    def run(self, app: Callable[[], None]) -> None:
        """Run the command. A defect of the program is reported as one."""
        streams.make_ready()
        try:
            signals.raise_interrupts()
            code = self._exit_code_of(app)
            signals.end_at_once()
        except KeyboardInterrupt:
            signals.end_at_once()
            code = INTERRUPTED
        garbage.look_no_more()
        sys.exit(signals.exit_code() or code)

    def _exit_code_of(self, app: Callable[[], None]) -> int | str | None:
        try:
            try:
                app()
            finally:
                sys.stdout.flush()
        except SystemExit as ended:
            # Typer ends the run like this if the output pipe is broken.
            return _UNHEARD if isinstance(ended.__context__, BrokenPipeError) else ended.code
        except Exception as error:
            return self._exit_code_after(error)
        return 0

    def _exit_code_after(self, error: Exception) -> int:
        """Print the error, except after an interrupt or a broken output pipe. Returns the exit
        code.
        """
        if (interrupted := signals.exit_code()) is not None:
            return interrupted
        if isinstance(error, BrokenPipeError) and error.filename is None:
            _drop(sys.stdout)
            return _UNHEARD
        code = INTERNAL_ERROR
        try:
            if isinstance(error, OSError) and _is_about_output(error):
                code = 2
                _drop(sys.stdout)
                self.complain(f"cannot write the output: {reason(error)}")
            elif isinstance(error, FileNotFoundError) and not _has_folder():
                code = 2
                self.complain("the current folder is gone: change to another one")
            elif isinstance(error, ModuleNotFoundError) and (
                advice := self.extras().explained(error)
            ):
                code = 2
                self.complain(advice)
            else:
                import traceback

                self._tell_defect(traceback.format_exc())
        except OSError:
            _drop(sys.stderr)
        return code

    def _tell_defect(self, detail: str) -> None:
        """Report a defect of the tool, with the details that its developers need."""
        title = f"this is a defect of {self.tool}, not of {self.subject}"
        typer.echo(f"error[{self.internal_code}]: {title}", err=True)
        typer.echo("please report it, with the file that you checked and these lines:", err=True)
        sys.stderr.write(detail)


def _drop(stream: TextIO) -> None:
    """Discard the remaining output of a stream. Otherwise Python fails again when it ends."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, stream.fileno())
    os.close(nowhere)


def _has_folder() -> bool:
    """True while the current folder exists."""
    try:
        Path.cwd()
    except FileNotFoundError:
        return False
    return True


def _is_about_output(error: OSError) -> bool:
    """Say whether an error is about standard output: such an error names no file."""
    return error.filename is None and error.errno in _OUTPUT_FAILURES
