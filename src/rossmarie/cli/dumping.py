"""`rossmarie dump`: the state of the compiler after a stage."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import typer

from rossmarie.cli.choices import DumpFormat, StageName
from rossmarie.cli.output import output
from rossmarie.driver import RulesError
from rossmarie.driver.dump import JSON_STAGES, CompilerStage, dump


def run_dump(
    rules: Path,
    after: StageName,
    form: DumpFormat,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
) -> None:
    """Print the state after a stage; a stage without a JSON form refuses that form."""
    stage, as_json = CompilerStage(after.value), form is DumpFormat.JSON
    if as_json and stage not in JSON_STAGES:
        those = " or ".join(one.value for one in JSON_STAGES)
        output.fail(f"--after {stage.value} has no JSON form; {those} has", exit_code=2)
    try:
        text = dump(rules, stage, as_json=as_json, systems=systems, message_folders=message_folders)
    except RulesError as error:
        output.reject(error.diagnostics)
    typer.echo(text, nl=False)
