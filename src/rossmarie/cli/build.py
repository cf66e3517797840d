"""`rossmarie build`: the files of a target."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import typer

from dslkit.command_line import Format
from rossmarie.cli.output import output
from rossmarie.driver import RulesError
from rossmarie.driver.build import build_files
from rossmarie.driver.ownership import ForeignFileError
from rossmarie.driver.writing import reason


def run_build(
    rules: Path,
    out: Path,
    target: str,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
) -> None:
    """Write the files of a target into `out`, and say what comes next."""
    try:
        built = build_files(rules, target, out, systems=systems, message_folders=message_folders)
    except RulesError as error:
        output.reject(error.diagnostics)
    except ForeignFileError as error:
        output.fail(f"{error}; remove it, or choose another --out", exit_code=2)
    except OSError as error:
        output.fail(f"cannot write to {out}: {reason(error)}", exit_code=2)
    output.print_diagnostics(built.warnings, Format.TEXT, file_count=1)
    for path in built.written:
        typer.echo(f"wrote {path}")
    if built.next_step:
        typer.echo(built.next_step)
