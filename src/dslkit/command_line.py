"""The common behavior of the commands of both languages.

Findings go to the terminal as text or, for machines, to standard output as JSON or SARIF; errors of
the command itself go to standard error.
"""

from __future__ import annotations

import enum
import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import typer

from dslkit.answer import Answer
from dslkit.diagnostics import Diagnostic, Severity, summary
from dslkit.ending import Ending
from dslkit.options import Format
from dslkit.ownership import Comment, NotOwnError, list_written, marked, require_own
from dslkit.writing import is_stream, reason, try_folder, try_writing, write_whole

if TYPE_CHECKING:  # not needed by a run without findings
    from rich.console import Console

    from dslkit.catalog import Catalog
    from dslkit.extras import Extras

_PROGRAMS = {"CHK": "crosscheck", "EZS": "ezskiros", "ROSS": "rossmarie"}
"""The programs that explain codes, by the letters of the codes."""


@dataclass
class _Permission:
    """The permission of the user to replace files that the program did not write."""

    is_given: bool = False


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
    permission: _Permission = field(default_factory=_Permission)
    _answers: list[Answer] = field(default_factory=list, init=False, repr=False, compare=False)

    def exit_code(self, found: Sequence[Diagnostic]) -> int:
        """The exit code: 0 without errors, 1 with errors, 2 if a file could not be read."""
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
        """Print findings as text, without a count, on standard output or on the given console.

        In a JSON answer the findings are collected instead, unless they are for another console.
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

    def explain(self, code: str, hint: str = "") -> None:
        """Print the page of a diagnostic; if no diagnostic has this code, print an error and the
        `hint`.
        """
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
        object is printed after an error as well. An answer inside another answer is that other
        answer.
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
            raise  # nothing may read the answer
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

    # --- output files -----------------------------------------------------------------------------

    def permit(self, force: bool) -> None:
        """Let the user's `--force` decide whether files of others are replaced."""
        self.permission.is_given = force

    def try_file(self, *paths: Path | None) -> None:
        """End the run early if one of these files cannot be written, or may not be replaced because
        another program or the user wrote it. None stands for no file.
        """
        wanted = [path for path in paths if path is not None]
        self._refuse_twice(wanted)
        for path in wanted:
            self.require_own_file(path)
        for path in wanted:
            self.try_change(path)

    def try_change(self, path: Path) -> None:
        """End the run if a file of the user that is to be changed cannot be written."""
        with self.writing(path):
            try_writing(path)

    def try_folder(self, folder: Path, *names: str) -> None:
        """End the run early if files cannot be written into a folder, or if files with these names
        may not be replaced.
        """
        with self.writing_to(folder):
            try_folder(folder)
        for name in names:
            self.require_own_file(folder / name)
            if (folder / name).exists():
                self.try_change(folder / name)

    def save(self, path: Path, text: str, comment: Comment | None = None) -> None:
        """Write a file with the mark of this program. The run ends if the file cannot be written.
        Give a `comment` for formats whose comment syntax the program does not know.
        """
        self.require_own_file(path)
        with self.writing(path):
            write_whole(path, self.marked(text, comment))

    def marked(self, text: str, comment: Comment | None = None) -> str:
        """Add the mark by which this program recognizes the file, as `ownership` does."""
        return marked(text, self.tool, comment)

    def tell_written(self, path: Path) -> None:
        """Report that a file was written: on standard error if standard output is for an answer or
        can be that file.
        """
        typer.echo(f"wrote {path}", err=bool(self._answers) or is_stream(path))

    def list_written(self, folder: Path, names: Sequence[str]) -> None:
        """Write the list of files in a folder that cannot hold a mark."""
        with self.writing_to(folder):
            list_written(folder, names, self.tool)

    def _refuse_twice(self, paths: Sequence[Path]) -> None:
        seen: dict[str, Path] = {}
        for path in paths:
            first = seen.setdefault(os.path.realpath(path), path)
            if first is not path and not is_stream(path):
                self.fail(f"two outputs have the same file, {path}: give two names", exit_code=2)

    def require_own_file(self, path: Path) -> None:
        """End the run if a file may not be written."""
        if str(path) == "-":
            self.fail("`-` is not a file: write /dev/stdout for standard output", exit_code=2)
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

    def refuse_present(self, paths: Sequence[Path]) -> NoReturn:
        """End the run because these files exist, and users complete them by hand."""
        names = ", ".join(map(str, paths))
        self.fail(
            f"nothing is written, because these are there: {names}; choose another folder, or "
            "replace them with --force",
            exit_code=2,
        )

    def copy_example(self, example: Path, folder: Path) -> None:
        """Copy a folder of examples and report each file. The run ends if a file exists and may not
        be replaced.
        """
        from dslkit.examples import FilesAreThereError, copy_example

        self.try_folder(folder)
        try:
            with self.writing_to(folder):
                written = copy_example(example, folder, replaces_others=self.permission.is_given)
        except FilesAreThereError as error:
            self.refuse_present(error.paths)
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
        """End the run early if a check could not append to a study log."""
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
        """Run the command. A defect of the program is reported as one."""
        Ending(self.tool, self.subject, self.internal_code, self.extras, self.complain).run(app)
