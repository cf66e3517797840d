"""`rossmarie fmt`: rules files in canonical layout."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import typer

from dslkit.options import Format
from dslkit.writing import reason, write_whole
from rossmarie.cli.output import output
from rossmarie.driver.formatting import Formatted, format_file


def run_fmt(files: Sequence[Path], check_only: bool) -> None:
    """Write each file in canonical layout, or only list the files that would change, and end."""
    exit_code = 0
    for path in files:
        result = format_file(path)
        if not isinstance(result, Formatted):
            output.print_diagnostics(result, Format.TEXT, file_count=1)
            exit_code = max(exit_code, output.exit_code(result))
        elif result.has_changed and check_only:
            typer.echo(f"would reformat {path}")
            exit_code = max(exit_code, 1)
        elif result.has_changed:
            try:
                write_whole(path, result.text)
            except OSError as error:
                output.complain(f"cannot write {path}: {reason(error)}")
                exit_code = 2
            else:
                typer.echo(f"reformatted {path}")
    raise typer.Exit(exit_code)
