"""`rossmarie verify`: proofs that the generated C implements the rules."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

import typer

from dslkit.diagnostics import Template
from dslkit.options import ReportFormat
from dslkit.source import Span
from rossmarie.cli.output import output
from rossmarie.cli.progress import reported_progress
from rossmarie.cli.saving import refuse_report
from rossmarie.cli.written import lines_of_written
from rossmarie.driver import RulesError
from rossmarie.driver.ownership import ForeignFileError
from rossmarie.driver.verifying import (
    VerificationQueries,
    complaint,
    keep,
    prove,
    queries_of,
    verification_report,
)
from rossmarie.ir import Category
from rossmarie.report.proofs import Proofs, refutations, write_proofs
from rossmarie.report.safety.errors import at_file
from rossmarie.verification.errors import NoProver, ProgramRefused
from rossmarie.verification.prover import Prover, ProverError


def run_verify(
    rules: Path,
    form: ReportFormat,
    *,
    timeout_s: int,
    report: Path | None,
    kept: Path | None,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
    only: Sequence[Category],
) -> None:
    """Prove, print the results, and end with 0 only if everything is proved. Write a `report` as
    JSON, and the input of the prover into the folder `kept`.
    """
    with output.answering(form, "verify", files=1) as answer:
        output.try_file(report)
        if kept is not None:
            output.try_folder(kept)
        try:
            queries = queries_of(rules, systems=systems, message_folders=message_folders, only=only)
        except RulesError as error:
            output.reject(error.diagnostics)
        output.print_findings(queries.compiled.warnings)
        if report is not None:
            refuse_report(report, [Path(each.path) for each in queries.compiled.sources])
        if kept is not None:
            _keep(queries, kept, rules)
        proofs = _proofs(queries, timeout_s)
        whole = Span(queries.compiled.sources[-1], 0, 0)
        output.print_findings(tuple(refutations(proofs, whole)))
        text = verification_report(queries, proofs, rules, version=output.own_version())
        answer.result = json.loads(text)
        if not answer.is_printed:
            write_proofs(proofs, sys.stdout)
        if report is not None:
            output.save(report, text)
            output.tell_written(report)
        raise typer.Exit(0 if proofs.is_complete else 1)


def _keep(queries: VerificationQueries, folder: Path, rules: Path) -> None:
    try:
        with output.writing_to(folder):
            paths = keep(queries, folder, rules, replaces_others=output.permission.is_given)
    except ForeignFileError as error:
        output.fail(f"{error}; choose another --keep, or replace it with --force", exit_code=2)
    for line in lines_of_written(paths):
        output.tell(line)


def _proofs(queries: VerificationQueries, timeout_s: int) -> Proofs:
    found = prover()
    try:
        with reported_progress("proving") as on_progress:
            return prove(queries, found, seconds=timeout_s, on_progress=on_progress)
    except ProverError as error:
        _give_up(ProgramRefused(reason=complaint(error)))


def prover() -> Prover:
    """The prover. The run ends if there is no prover."""
    output.require("prover")
    found = Prover()
    reason = found.lacking()
    if reason is not None:
        _give_up(NoProver(reason=reason))
    return found


def _give_up(finding: Template) -> NoReturn:
    output.print_findings([at_file(finding, Path("cbmc"))])
    raise typer.Exit(1)
