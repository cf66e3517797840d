"""How the command line speaks: findings, pages, and the end of a run.

Findings go to the terminal as text or, for machines, to standard output as JSON or SARIF; what went
wrong with the command itself goes to standard error.
"""

from __future__ import annotations

import enum
import errno
import os
import sys
from collections.abc import Iterable, Sequence
from importlib.metadata import version
from typing import NoReturn

import typer
from rich.console import Console

from dslkit.diagnostics import Diagnostic, Severity, summary

INTERNAL_ERROR = 70
"""The exit code for a defect of this tool (sysexits: EX_SOFTWARE)."""

_OUTPUT_FAILURES = frozenset(
    (errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EFBIG, errno.EPIPE, errno.EBADF)
)
_UNREADABLE = frozenset({"ROSS610", "ROSS611", "ROSS801", "ROSS802"})


class Format(str, enum.Enum):
    """How findings are printed."""

    TEXT = "text"
    JSON = "json"
    SARIF = "sarif"


def exit_code(found: Sequence[Diagnostic]) -> int:
    """0 without errors, 1 with errors, 2 if a file could not be read."""
    codes = {finding.code for finding in found if finding.severity is Severity.ERROR}
    if codes & _UNREADABLE:
        return 2
    return 1 if codes else 0


def own_version() -> str:
    """The installed version of this tool."""
    return version("rossmarie")


def each_once(found: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """The findings, each once: what two rules files import is checked with each of them."""
    kept: dict[tuple[object, ...], Diagnostic] = {}
    for finding in found:
        span = finding.primary.span
        place = (os.path.realpath(span.file.path), span.start, span.end)
        kept.setdefault((finding.code, finding.title, *place), finding)
    return tuple(kept.values())


def print_diagnostics(found: Sequence[Diagnostic], form: Format, *, file_count: int) -> None:
    """All findings; as text with a closing line that counts them."""
    if form is Format.TEXT:
        print_findings(found)
        typer.echo(summary(found, file_count))
    elif form is Format.JSON:
        from dslkit.diagnostics.render_json import render_json

        typer.echo(render_json(found, file_count=file_count), nl=False)
    else:
        from dslkit.diagnostics.render_sarif import render_sarif
        from rossmarie.catalog import sarif_rules

        typer.echo(render_sarif(found, sarif_rules(own_version())), nl=False)


def print_findings(found: Sequence[Diagnostic]) -> None:
    """The findings as text, without a count."""
    from dslkit.diagnostics.render_text import render_text

    console = Console(highlight=False)
    if console.is_terminal:
        console.print(render_text(found, width=console.width), end="", soft_wrap=True)
    else:
        typer.echo(render_text(found).plain, nl=False)


def print_page(text: str) -> None:
    """A page in Markdown: laid out on a terminal, as it is elsewhere."""
    console = Console()
    if console.is_terminal:
        from rich.markdown import Markdown

        console.print(Markdown(text))
    else:
        typer.echo(text, nl=False)


def reject(found: Sequence[Diagnostic]) -> NoReturn:
    """Print findings of which at least one is an error, and end the run."""
    print_diagnostics(found, Format.TEXT, file_count=1)
    raise typer.Exit(exit_code(found))


def complain(message: str) -> None:
    """One line on standard error."""
    typer.echo(f"rossmarie: {message}", err=True)


def fail(message: str, *, exit_code: int) -> NoReturn:
    """End the run with one line on standard error."""
    complain(message)
    raise typer.Exit(exit_code)


def is_about_output(error: OSError) -> bool:
    """Whether standard output cannot be written to: such an error names no file."""
    return error.filename is None and error.errno in _OUTPUT_FAILURES


def give_up_output(error: OSError) -> None:
    """Say that standard output cannot be written to, and drop what is left for it."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())  # otherwise Python fails once more when it ends
    os.close(nowhere)
    complain(f"cannot write the output: {(error.strerror or 'it is gone').lower()}")


def internal_error(detail: str) -> None:
    """Say that the tool is at fault, with what its makers need to know."""
    typer.echo("error[ROSS900]: this is a defect of rossmarie, not of your rules", err=True)
    typer.echo("please report it, with the file that you checked and these lines:", err=True)
    sys.stderr.write(detail)
