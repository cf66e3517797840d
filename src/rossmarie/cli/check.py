"""`rossmarie check`: the findings on rules files."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import typer

from dslkit.diagnostics import Diagnostic
from dslkit.extensions import extension
from dslkit.options import Format
from rossmarie.cli.output import each_once, output
from rossmarie.cli.progress import reported_steps
from rossmarie.driver.analyze import Analysis, analyze_file, write_witnesses
from rossmarie.ir import Category

_TOGGLE_S = 1.0


def run_check(
    files: Sequence[Path],
    form: Format,
    target: str | None,
    thorough: bool,
    toggle_s: float | None,
    witnesses: Path | None,
    skills: bool,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
    only: Sequence[Category],
    study: Path | None,
) -> None:
    """Print the findings, write the witnesses, and end with the exit code."""
    with output.answering(form, "check", files=len(files)):
        output.try_study(study)
        if toggle_s is not None and not thorough:
            output.fail(
                "--toggle needs --thorough: the other queries do not look for toggling rules",
                exit_code=2,
            )
        is_tests = witnesses is not None and witnesses.suffix == ".ross"
        if is_tests and len(files) > 1:
            output.fail("tests of witnesses are for one rules file; name one", exit_code=2)
        if thorough or witnesses is not None:
            output.require("solver")
        together = _looking_at_both() if skills else None
        if witnesses is not None:
            (output.try_file if is_tests else output.try_folder)(witnesses)
        with reported_steps("reading the rules") as on_step:
            analyses = [
                analyze_file(
                    path,
                    thorough=thorough,
                    toggle_ns=round((_TOGGLE_S if toggle_s is None else toggle_s) * 1e9),
                    systems=systems,
                    message_folders=message_folders,
                    only=only,
                    on_step=on_step,
                )
                for path in files
            ]
        found: list[Diagnostic] = []
        for path, analysis in zip(files, analyses, strict=True):
            found += analysis.diagnostics
            if target is not None:
                found += _for_target(path, target, systems, message_folders, only)
            if together is not None:
                found += together(path, systems=systems, message_folders=message_folders)
        reported = each_once(found)
        output.log_study(study, "check", files, reported)
        output.print_diagnostics(reported, form, file_count=len(files))
        if witnesses is not None and is_tests:
            _write_tests(analyses[0], files[0], witnesses, form, systems, message_folders)
        elif witnesses is not None:
            _write(analyses, witnesses, form)
        raise typer.Exit(output.exit_code(reported))


def _looking_at_both() -> Callable[..., Sequence[Diagnostic]]:
    """The joint check of rules and skills, which belongs to another package."""
    found = extension("rossmarie.check", "skills")
    if found is None:
        advice = output.extras().advice("skills")
        output.fail(f"`--skills` needs the package crosscheck: {advice}", exit_code=2)
    return found


def _for_target(
    path: Path,
    target: str,
    systems: Sequence[Path],
    folders: Sequence[Path],
    only: Sequence[Category],
) -> Sequence[Diagnostic]:
    """Find unsupported features of a target. Returns them with all findings of the check."""
    from rossmarie.driver.build import check_for

    return check_for(target, path, systems=systems, message_folders=folders, only=only)


def _write(analyses: Sequence[Analysis], folder: Path, form: Format) -> None:
    names = [name for each in analyses for name in each.witnesses]
    output.try_folder(folder, *names)
    with output.writing_to(folder):
        written = [path for each in analyses for path in write_witnesses(each, folder)]
    if names:
        output.list_written(folder, names)
    for path in written:
        typer.echo(f"wrote {path}", err=form is not Format.TEXT)


def _write_tests(
    analysis: Analysis,
    rules: Path,
    path: Path,
    form: Format,
    systems: Sequence[Path],
    folders: Sequence[Path],
) -> None:
    from rossmarie.driver.witness_tests import witness_tests

    found = witness_tests(analysis, rules, path, systems=systems, message_folders=folders)
    if found is None:
        return
    output.save(path, found.text)
    tests = "1 test" if found.count == 1 else f"{found.count} tests"
    typer.echo(f"wrote {tests} to {path}", err=form is not Format.TEXT)
    for name in found.left_out:
        typer.echo(f"cannot be reported as a test: {name}", err=True)
