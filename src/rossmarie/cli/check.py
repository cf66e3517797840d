"""`rossmarie check`: the findings on rules files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import typer

from dslkit.command_line import Format
from dslkit.diagnostics import Diagnostic
from rossmarie.cli.output import each_once, output
from rossmarie.driver.analyze import Analysis, analyze_file, write_witnesses
from rossmarie.driver.writing import reason


def run_check(
    files: Sequence[Path],
    form: Format,
    target: str | None,
    thorough: bool,
    toggle_s: float,
    witnesses: Path | None,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
) -> None:
    """Print the findings, write the witnesses, and end with the exit code."""
    analyses = [
        analyze_file(
            path,
            thorough=thorough,
            toggle_ns=round(toggle_s * 1e9),
            systems=systems,
            message_folders=message_folders,
        )
        for path in files
    ]
    found: list[Diagnostic] = []
    for path, analysis in zip(files, analyses, strict=True):
        found += analysis.diagnostics
        if target is not None:
            found += _for_target(path, target, systems, message_folders)
    told = each_once(found)
    output.print_diagnostics(told, form, file_count=len(files))
    if witnesses is not None:
        _write(analyses, witnesses, form)
    raise typer.Exit(output.exit_code(told))


def _for_target(
    path: Path, target: str, systems: Sequence[Path], folders: Sequence[Path]
) -> Sequence[Diagnostic]:
    """What a target cannot do, and all findings of the check once more."""
    from rossmarie.driver.build import check_for

    return check_for(target, path, systems=systems, message_folders=folders)


def _write(analyses: Sequence[Analysis], folder: Path, form: Format) -> None:
    try:
        written = [path for each in analyses for path in write_witnesses(each, folder)]
    except OSError as error:
        output.fail(f"cannot write to {folder}: {reason(error)}", exit_code=2)
    for path in written:
        typer.echo(f"wrote {path}", err=form is not Format.TEXT)
