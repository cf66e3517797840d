"""`rossmarie report`: the safety file of a rules file, written as one HTML page."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from datetime import date, datetime, timezone
from pathlib import Path

import typer

from rossmarie.cli.output import output
from rossmarie.driver import RulesError
from rossmarie.driver.report import safety_file
from rossmarie.ir import Category
from rossmarie.report.safety import open_points, render_safety_file
from rossmarie.report.safety.errors import EvidenceError

_RULES = ".ross"


def run_report(
    rules: Path,
    out: Path,
    verification: Path | None,
    coverage: Path | None,
    day: str | None,
    thorough: bool,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
    only: Sequence[Category],
) -> None:
    """Write the page to `out`. A rules file is not overwritten."""
    if out.suffix == _RULES:
        output.fail(f"{out} would be a rules file; choose another --out", exit_code=2)
    if day is not None and _parsed(day) is None:
        output.fail(f"--date needs YYYY-MM-DD, not `{day}`", exit_code=2)
    output.try_file(out)
    try:
        content, found = safety_file(
            rules,
            tool=f"rossmarie {output.own_version()}",
            date=day or _today(),
            verification=verification,
            coverage=coverage,
            thorough=thorough,
            systems=systems,
            message_folders=message_folders,
            only=only,
        )
    except RulesError as error:
        output.reject(error.diagnostics)
    except EvidenceError as error:
        output.print_findings([error.diagnostic])
        raise typer.Exit(output.exit_code([error.diagnostic])) from None
    output.print_findings(found)
    output.save(out, render_safety_file(content))
    output.tell_written(out)
    for point in open_points(content):
        typer.echo(f"not done: {point}")


def _today() -> str:
    """The date in SOURCE_DATE_EPOCH (reproducible builds), else today's date in UTC."""
    epoch = os.environ.get("SOURCE_DATE_EPOCH")
    if epoch is None:
        return datetime.now(tz=timezone.utc).date().isoformat()
    try:
        return datetime.fromtimestamp(int(epoch), tz=timezone.utc).date().isoformat()
    except (ValueError, OverflowError, OSError):
        output.fail(f"SOURCE_DATE_EPOCH is not a time in seconds: `{epoch}`", exit_code=2)


def _parsed(day: str) -> date | None:
    """The date, if it has the format of the option."""
    try:
        return date.fromisoformat(day) if re.fullmatch(r"\d{4}-\d{2}-\d{2}", day) else None
    except ValueError:
        return None
