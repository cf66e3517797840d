"""The common behavior of the commands of both languages.

Findings go to the terminal as text or, for machines, to standard output as JSON or SARIF; errors of
the command itself go to standard error.
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
from dslkit.answer import Answer
from dslkit.diagnostics import Diagnostic, Severity, summary
from dslkit.writing import reason, try_folder, try_writing, write_whole

if TYPE_CHECKING:  # a run without findings needs neither
    from rich.console import Console

    from dslkit.catalog import Catalog
    from dslkit.extras import Extras

INTERNAL_ERROR = 70
"""The exit code for a defect of the tool (sysexits: EX_SOFTWARE)."""

INTERRUPTED = 128 + signal.SIGINT
"""The exit code of an interrupted run."""

StudyFile = Annotated[
    Path | None,
    typer.Option(
        "--study",
        metavar="FILE",
        help="Append the codes and places of the findings to this study log.",
        readable=False,
    ),
]
"""The option that a check has for studies with users; without it a check keeps no record."""

_UNHEARD = 141  # that of a program which SIGPIPE ends: 128 + 13
_OUTPUT_FAILURES = frozenset((errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EFBIG, errno.EBADF))


class Format(str, enum.Enum):
    """The formats in which a check prints its findings."""

    TEXT = "text"
    JSON = "json"
    SARIF = "sarif"


class ReportFormat(str, enum.Enum):
    """The formats in which the other commands print their findings and their result."""

    TEXT = "text"
    JSON = "json"


@dataclass(frozen=True)
class CommandLine:
    """The output of one command.

    `subject` is the kind of its input, `internal_code` the code of the diagnostic for its own
    defects. Errors with a code in `unreadable` mean that a file could not be read. The catalog is
    loaded on demand.
    """

    tool: str
    subject: str
    internal_code: str
    unreadable: frozenset[str]
    catalog: Callable[[], Catalog]
    distribution: str
    extras: Callable[[], Extras]
    _answers: list[Answer] = field(default_factory=list, init=False, repr=False, compare=False)

    def exit_code(self, found: Sequence[Diagnostic]) -> int:
        """0 without errors, 1 with errors, 2 if a file could not be read."""
        codes = {finding.code for finding in found if finding.severity is Severity.ERROR}
        if codes & self.unreadable:
            return 2
        return 1 if codes else 0

    def own_version(self) -> str:
        """The installed version."""
        from importlib.metadata import version

        return version(self.distribution)

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
        """Print all findings: as text with a closing line that counts them, or in the answer."""
        if self._answers:
            self._answers[-1].add(found)
            self._answers[-1].files = file_count
        elif form is not Format.SARIF:
            self.print_findings(found)
            typer.echo(summary(found, file_count))
        else:
            from dslkit.diagnostics.render_sarif import render_sarif

            tool = self.catalog().sarif_tool(self.own_version())
            typer.echo(render_sarif(found, tool), nl=False)

    def print_findings(self, found: Sequence[Diagnostic], console: Console | None = None) -> None:
        """Print findings as text, without a count: on standard output, if nothing else is given.

        An answer as JSON collects the findings instead, unless they are for another console.
        """
        if not found:
            return
        if self._answers and console is None:
            self._answers[-1].add(found)
            return
        from rich.console import Console

        from dslkit.diagnostics.render_text import render_text

        console = console or Console(highlight=False)
        if console.is_terminal:
            console.print(render_text(found, width=console.width), end="", soft_wrap=True)
        else:
            typer.echo(render_text(found).plain, nl=False, file=console.file)

    def print_page(self, text: str) -> None:
        """Print a page in Markdown: laid out on a terminal, unchanged elsewhere."""
        from rich.console import Console

        console = Console()
        if console.is_terminal:
            from rich.markdown import Markdown

            console.print(Markdown(text))
        else:
            typer.echo(text, nl=False)

    def explain(self, code: str) -> None:
        """Print the page of a diagnostic."""
        from dslkit.catalog import UnknownCodeError

        try:
            text = self.catalog().page(code)
        except UnknownCodeError as error:
            self.fail(str(error), exit_code=2)
        self.print_page(text)

    def reject(self, found: Sequence[Diagnostic]) -> NoReturn:
        """Print findings of which at least one is an error, and end the run."""
        if self._answers:
            self._answers[-1].add(found)
            raise typer.Exit(self.exit_code(found))
        files = {each.primary.span.file.path for each in found}
        self.print_diagnostics(found, Format.TEXT, file_count=len(files))
        raise typer.Exit(self.exit_code(found))

    def complain(self, message: str) -> None:
        """Print one line on standard error."""
        typer.echo(f"{self.tool}: {message}", err=True)

    def fail(self, message: str, *, exit_code: int) -> NoReturn:
        """End the run with one line on standard error; an answer as JSON has the line, too."""
        self.complain(message)
        if self._answers:
            self._answers[-1].error = message
        raise typer.Exit(exit_code)

    def require(self, *extras: str) -> None:
        """End the run with advice if one of these extras is not installed."""
        known = self.extras()
        missing = [module for extra in extras for module in known.missing(extra)]
        if missing:
            modules, advice = ", ".join(missing), known.advice(*extras)
            self.fail(f"this needs {modules}, not installed here: {advice}", exit_code=2)

    # --- answers for programs ---------------------------------------------------------------------

    @contextmanager
    def answering(self, form: enum.Enum, command: str, *, files: int) -> Iterator[Answer]:
        """While the context is active, a command whose `form` is JSON prints nothing on standard
        output. At the end it prints one JSON object with all findings and the result of the answer.

        `command` is the name of the command, `files` the number of files that the user named. The
        object is printed after an error as well. An answer within another one is that other one.
        """
        if self._answers:
            yield self._answers[-1]
            return
        answer = Answer(f"{self.tool} {command}", files, is_printed=form.value == Format.JSON.value)
        if not answer.is_printed:
            yield answer
            return
        self._answers.append(answer)
        try:
            yield answer
        except typer.Exit:
            typer.echo(answer.text(), nl=False)
            raise
        except (OSError, KeyboardInterrupt):
            raise  # there may be no reader for the answer
        except Exception as error:
            lacks = isinstance(error, ModuleNotFoundError) and self.extras().explained(error)
            defect = f"this is a defect of {self.tool}; standard error has the details"
            answer.error = lacks or defect
            typer.echo(answer.text(), nl=False)
            raise
        else:
            typer.echo(answer.text(), nl=False)
        finally:
            self._answers.pop()

    def tell(self, line: str) -> None:
        """Print a line about the run: on standard error if standard output is for an answer."""
        typer.echo(line, err=bool(self._answers))

    # --- what is written --------------------------------------------------------------------------

    def try_file(self, path: Path) -> None:
        """End the run early if a file cannot be written at its end."""
        with self.writing(path):
            try_writing(path)

    def try_folder(self, folder: Path) -> None:
        """End the run early if files cannot be written into a folder at its end."""
        with self.writing_to(folder):
            try_folder(folder)

    def save(self, path: Path, text: str) -> None:
        """Write a file. If that is not possible, the run ends."""
        with self.writing(path):
            write_whole(path, text)

    def copy_example(self, example: Path, folder: Path) -> None:
        """Copy a folder of examples and name each file. If a file exists already, the run ends."""
        from dslkit.examples import FilesAreThereError, copy_example

        self.try_folder(folder)
        try:
            with self.writing_to(folder):
                written = copy_example(example, folder)
        except FilesAreThereError as error:
            paths = ", ".join(map(str, error.paths))
            self.fail(f"nothing is written, because these are there: {paths}", exit_code=2)
        for path in written:
            typer.echo(f"wrote {path}")

    @contextmanager
    def writing(self, path: Path) -> Iterator[None]:
        """While the context is active, a file that cannot be written ends the run."""
        try:
            yield
        except OSError as error:
            self.fail(f"cannot write {path}: {reason(error)}", exit_code=2)

    @contextmanager
    def writing_to(self, folder: Path) -> Iterator[None]:
        """While the context is active, a folder that cannot be written to ends the run."""
        try:
            yield
        except OSError as error:
            self.fail(f"cannot write to {folder}: {reason(error)}", exit_code=2)

    # --- studies with users ----------------------------------------------------------------------

    def try_study(self, log: Path | None) -> None:
        """End the run, before it takes its time, if a check could not append to a study log."""
        if log is None:
            return
        from dslkit import study

        with self.writing(log):
            try:
                study.try_log(log)
            except study.StudyLogError as problem:
                place = f"{log}:{problem.line}:1" if problem.line else str(log)
                self.fail(
                    f"{place}: {problem.reason}, so {log} is not a study log; "
                    "name another file or a new one",
                    exit_code=2,
                )

    def log_study(
        self, log: Path | None, command: str, files: Sequence[Path], found: Sequence[Diagnostic]
    ) -> None:
        """Append a run of `command` over `files` to a study log; do nothing without a log."""
        if log is None:
            return
        from dslkit import study

        with self.writing(log):
            study.append(
                log,
                tool=self.tool,
                command=command,
                release=self.own_version(),
                files=files,
                found=found,
            )

    # --- how it ends ------------------------------------------------------------------------------

    def run(self, app: Callable[[], None]) -> None:
        """Run the command. A defect of this program is reported as one."""
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
            # Typer ends the run like this if the reader of its output has gone.
            return _UNHEARD if isinstance(ended.__context__, BrokenPipeError) else ended.code
        except Exception as error:
            return self._exit_code_after(error)
        return 0

    def _exit_code_after(self, error: Exception) -> int:
        """Print the error, unless it comes from an interrupt or there is no reader. Returns the
        exit code.
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
        """Report a defect of the tool, with the data that its developers need."""
        title = f"this is a defect of {self.tool}, not of {self.subject}"
        typer.echo(f"error[{self.internal_code}]: {title}", err=True)
        typer.echo("please report it, with the file that you checked and these lines:", err=True)
        sys.stderr.write(detail)


def _drop(stream: TextIO) -> None:
    """Drop the remaining output of a stream: otherwise Python fails again at its end."""
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
