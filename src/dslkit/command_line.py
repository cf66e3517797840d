"""The manners of a command line: all that is the same in the commands of both languages.

Findings go to the terminal as text or, for machines, to standard output as JSON or SARIF; what went
wrong with the command itself goes to standard error.
"""

from __future__ import annotations

import enum
import errno
import os
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn, TextIO

import typer

from dslkit import garbage, signals, streams
from dslkit.diagnostics import Diagnostic, Severity, summary
from dslkit.ownership import Comment, NotOwnError, list_written, marked, require_own
from dslkit.writing import is_stream, reason, try_folder, try_writing, write_whole

if TYPE_CHECKING:  # a run without findings needs neither
    from rich.console import Console

    from dslkit.catalog import Catalog

INTERNAL_ERROR = 70
"""The exit code for a defect of the tool (sysexits: EX_SOFTWARE)."""

INTERRUPTED = 128 + signal.SIGINT
"""The exit code of a run that somebody has interrupted."""

_PROGRAMS = {"CHK": "crosscheck", "EZS": "ezskiros", "ROSS": "rossmarie"}
"""The programs that explain codes, by the letters of the codes."""
_UNHEARD = 141  # that of a program which SIGPIPE ends: 128 + 13
_OUTPUT_FAILURES = frozenset((errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EFBIG, errno.EBADF))

Force = Annotated[
    bool, typer.Option("--force", help="Replace files that this program did not write.")
]
"""The option of every command that writes files; its first statement is `output.permit(force)`."""


class Format(str, enum.Enum):
    """The format in which findings are printed."""

    TEXT = "text"
    JSON = "json"
    SARIF = "sarif"


@dataclass
class _Permission:
    """The permission of the user to replace files that the program did not write."""

    is_given: bool = False


@dataclass(frozen=True)
class CommandLine:
    """The voice of one command.

    `subject` is what its users write, `internal_code` that of the diagnostic for its own defects;
    errors with a code of `unreadable` mean that a file could not be read. The catalog is loaded
    when it is needed.
    """

    tool: str
    subject: str
    internal_code: str
    unreadable: frozenset[str]
    catalog: Callable[[], Catalog]
    permission: _Permission = field(default_factory=_Permission)

    def exit_code(self, found: Sequence[Diagnostic]) -> int:
        """0 without errors, 1 with errors, 2 if a file could not be read."""
        codes = {finding.code for finding in found if finding.severity is Severity.ERROR}
        if codes & self.unreadable:
            return 2
        return 1 if codes else 0

    def own_version(self) -> str:
        """The installed version."""
        from importlib.metadata import version

        return version("rossmarie")

    def version_option(self) -> Any:
        """The option `--version` of Typer, which prints the version and ends the run."""

        def print_version(wanted: bool) -> None:
            if wanted:
                typer.echo(f"{self.tool} {self.own_version()}")
                raise typer.Exit

        return typer.Option(
            "--version", help="Print the version.", is_eager=True, callback=print_version
        )

    def print_diagnostics(
        self, found: Sequence[Diagnostic], form: Format, *, file_count: int
    ) -> None:
        """All findings; as text with a closing line that counts them."""
        if form is Format.TEXT:
            self.print_findings(found)
            typer.echo(summary(found, file_count))
        elif form is Format.JSON:
            from dslkit.diagnostics.render_json import render_json

            typer.echo(render_json(found, file_count=file_count), nl=False)
        else:
            from dslkit.diagnostics.render_sarif import render_sarif

            tool = self.catalog().sarif_tool(self.own_version())
            typer.echo(render_sarif(found, tool), nl=False)

    def print_findings(self, found: Sequence[Diagnostic], console: Console | None = None) -> None:
        """The findings as text, without a count: on standard output, if nothing else is given."""
        if not found:
            return
        from rich.console import Console

        from dslkit.diagnostics.render_text import render_text

        console = console or Console(highlight=False)
        if console.is_terminal:
            console.print(render_text(found, width=console.width), end="", soft_wrap=True)
        else:
            typer.echo(render_text(found).plain, nl=False, file=console.file)

    def print_page(self, text: str) -> None:
        """A page in Markdown: laid out on a terminal, as it is elsewhere."""
        from rich.console import Console

        console = Console()
        if console.is_terminal:
            from rich.markdown import Markdown

            console.print(Markdown(text))
        else:
            typer.echo(text, nl=False)

    def explain(self, code: str, hint: str = "") -> None:
        """Print the page of a diagnostic; the `hint` follows if there is none with this code."""
        from dslkit.catalog import UnknownCodeError

        try:
            text = self.catalog().page(code)
        except UnknownCodeError as error:
            program = _PROGRAMS.get(code.strip().upper().rstrip("0123456789"))
            if program not in (None, self.tool):
                code = code.strip().upper()
                self.fail(
                    f"{code} is a code of {program}: run `{program} explain {code}`", exit_code=2
                )
            self.fail(f"{error}{hint}", exit_code=2)
        self.print_page(text)

    def reject(self, found: Sequence[Diagnostic]) -> NoReturn:
        """Print findings of which at least one is an error, and end the run."""
        files = {each.primary.span.file.path for each in found}
        self.print_diagnostics(found, Format.TEXT, file_count=len(files))
        raise typer.Exit(self.exit_code(found))

    def complain(self, message: str) -> None:
        """One line on standard error."""
        typer.echo(f"{self.tool}: {message}", err=True)

    def fail(self, message: str, *, exit_code: int) -> NoReturn:
        """End the run with one line on standard error."""
        self.complain(message)
        raise typer.Exit(exit_code)

    # --- what is written --------------------------------------------------------------------------

    def permit(self, force: bool) -> None:
        """Let the user's `--force` decide whether files of others are replaced."""
        self.permission.is_given = force

    def try_file(self, *paths: Path | None) -> None:
        """End the run, before it takes its time, if it could not write one of these files after it,
        or may not, because somebody else wrote what is there. None stands for no file.
        """
        wanted = [path for path in paths if path is not None]
        self._refuse_twice(wanted)
        for path in wanted:
            self.require_own_file(path)
        for path in wanted:
            self.try_change(path)

    def try_change(self, path: Path) -> None:
        """End the run if a file of the user, which is to be changed, could not be written."""
        with self.writing(path):
            try_writing(path)

    def try_folder(self, folder: Path, *names: str) -> None:
        """End the run, before it takes its time, if it could not write files into a folder, or may
        not write those with these names.
        """
        with self.writing_to(folder):
            try_folder(folder)
        for name in names:
            self.require_own_file(folder / name)
            if (folder / name).exists():
                self.try_change(folder / name)

    def save(self, path: Path, text: str, comment: Comment | None = None) -> None:
        """Write a file with the mark of this program; the run ends if that cannot be done.
        `comment` is for formats that do not show by themselves how comments look in them.
        """
        self.require_own_file(path)
        with self.writing(path):
            write_whole(path, self.marked(text, comment))

    def marked(self, text: str, comment: Comment | None = None) -> str:
        """Add the mark by which this program knows the file again, as `ownership` does."""
        return marked(text, self.tool, comment)

    def tell_written(self, path: Path) -> None:
        """Say that a file was written; on standard error if standard output can be the file."""
        typer.echo(f"wrote {path}", err=is_stream(path))

    def list_written(self, folder: Path, names: Sequence[str]) -> None:
        """Write the list of files in a folder that cannot hold a mark."""
        with self.writing_to(folder):
            list_written(folder, names, self.tool)

    def _refuse_twice(self, paths: Sequence[Path]) -> None:
        seen: dict[str, Path] = {}
        for path in paths:
            first = seen.setdefault(os.path.realpath(path), path)
            if first is not path and not is_stream(path):
                self.fail(f"two outputs go to one file, {path}: give them two names", exit_code=2)

    def require_own_file(self, path: Path) -> None:
        """End the run if a file may not be written."""
        if str(path) == "-":
            self.fail("`-` is no file: name /dev/stdout for standard output", exit_code=2)
        if self.permission.is_given:
            return
        with self.writing(path):
            try:
                require_own(path, self.tool)
            except NotOwnError:
                self.fail(
                    f"{path} is there, and {self.tool} did not write it: choose another name, or "
                    "replace it with --force",
                    exit_code=2,
                )

    @contextmanager
    def writing(self, path: Path) -> Iterator[None]:
        """Within, a file that cannot be written ends the run."""
        try:
            yield
        except OSError as error:
            self.fail(f"cannot write {path}: {reason(error)}", exit_code=2)

    @contextmanager
    def writing_to(self, folder: Path) -> Iterator[None]:
        """Within, a folder that cannot be written to ends the run."""
        try:
            yield
        except OSError as error:
            self.fail(f"cannot write to {folder}: {reason(error)}", exit_code=2)

    # --- how it ends ------------------------------------------------------------------------------

    def run(self, app: Callable[[], None]) -> None:
        """Run the command; a defect of ours is reported as one."""
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
            # Typer ends the run so if nobody reads what it writes.
            return _UNHEARD if isinstance(ended.__context__, BrokenPipeError) else ended.code
        except Exception as error:
            return self._exit_code_after(error)
        return 0

    def _exit_code_after(self, error: Exception) -> int:
        """Say what is wrong, unless it comes from an interrupt or nobody listens."""
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
            else:
                import traceback

                self._tell_defect(traceback.format_exc())
        except OSError:
            _drop(sys.stderr)
        return code

    def _tell_defect(self, detail: str) -> None:
        """Say that the tool is at fault, with what its makers need to know."""
        title = f"this is a defect of {self.tool}, not of {self.subject}"
        typer.echo(f"error[{self.internal_code}]: {title}", err=True)
        typer.echo("please report it, with the file that you checked and these lines:", err=True)
        sys.stderr.write(detail)


def _drop(stream: TextIO) -> None:
    """Drop what is left for a stream: otherwise Python fails once more when it ends."""
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
    """Say whether standard output cannot be written to: such an error names no file."""
    return error.filename is None and error.errno in _OUTPUT_FAILURES
