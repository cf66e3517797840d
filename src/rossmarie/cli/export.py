"""`rossmarie export`: a description of a rules file for other programs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rossmarie.cli.output import output
from rossmarie.driver import RulesError, compile_file
from rossmarie.driver.rules_file import rules_file


def run_export(
    rules: Path, out: Path, systems: Sequence[Path], message_folders: Sequence[Path]
) -> None:
    """Check a rules file, and write its description for other programs to `out`."""
    if out.suffix != ".json":
        output.fail(f"{out} does not end in .json; choose another --out", exit_code=2)
    output.try_file(out)
    try:
        compiled = compile_file(rules, systems=systems, message_folders=message_folders)
    except RulesError as error:
        output.reject(error.diagnostics)
    output.save(out, rules_file(compiled.machine, compiled.sources, out))
    output.tell_written(out)
