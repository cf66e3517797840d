"""`rossmarie test` and `rossmarie coverage`: the coverage of rules by tests and recordings."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import typer

from dslkit.answer import Answer
from dslkit.diagnostics.render_json import Json
from dslkit.options import ReportFormat
from dslkit.writing import reason
from rossmarie.cli.junit import junit_text
from rossmarie.cli.output import output
from rossmarie.cli.progress import reported_progress
from rossmarie.cli.replay import refusing, topic_pairs
from rossmarie.cli.saving import refuse_report
from rossmarie.driver import RulesError
from rossmarie.driver.coverage import Exercised, cover_recordings, coverage_report
from rossmarie.driver.generating import generate_tests
from rossmarie.driver.testing import RanTests, UnknownTestError, run_test_file, tests_beside
from rossmarie.ir import near_name
from rossmarie.report.coverage import write_coverage
from rossmarie.report.margins import write_margins
from rossmarie.report.safety.exercised import coverage_results


def run_test(
    rules: Path,
    names: Sequence[str],
    form: ReportFormat,
    *,
    write: bool,
    junit: Path | None,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
) -> None:
    """Run the tests, and print their results and coverage. With `write`, generate them first."""
    with output.answering(form, "test", files=1) as answer:
        output.try_file(junit)
        try:
            if write:
                _write(rules, systems, message_folders)
            tested = run_test_file(rules, names, systems=systems, message_folders=message_folders)
        except RulesError as error:
            output.reject(error.diagnostics)
        except UnknownTestError as error:
            near = near_name(error.wanted, error.known)
            hint = f"; did you mean `{near}`?" if near else ""
            output.fail(f"{error}{hint}", exit_code=2)
        report(tested, answer)
        if junit is not None:
            output.save(junit, junit_text(tested))
        raise typer.Exit(0 if tested.ran and not any(ran.found for ran in tested.ran) else 1)


def _write(rules: Path, systems: Sequence[Path], message_folders: Sequence[Path]) -> None:
    """Write the tests of all boundaries into a file beside the rules."""
    if tests_beside(rules) == rules:
        output.fail(f"{rules} contains tests; name the rules file of the tests", exit_code=2)
    output.try_file(tests_beside(rules))
    written = generate_tests(rules, systems=systems, message_folders=message_folders)
    output.save(written.path, written.text)
    output.tell(f"wrote {_counted(written.count, 'test')} to {written.path}")
    for reported in written.left_out:
        output.tell(reported)


def report(tested: RanTests, answer: Answer) -> None:
    """Print the findings, the counts and the coverage."""
    found = [finding for ran in tested.ran for finding in ran.found]
    output.print_findings([*tested.findings, *found])
    answer.result = tests_result(tested)
    if not tested.ran or answer.is_printed:
        return
    failed = sum(bool(ran.found) for ran in tested.ran)
    where = "on the interpreter and in C" if tested.has_c else "on the interpreter only"
    write_coverage(tested.coverage, sys.stdout, tested.reasons)
    typer.echo()
    counts = f"{_counted(len(tested.ran) - failed, 'test')} passed, {failed} failed"
    typer.echo(f"{counts}; run {where}")


def _counted(count: int, what: str) -> str:
    return f"{count} {what}{'' if count == 1 else 's'}"


def run_coverage(
    rules: Path,
    recordings: Sequence[Path],
    topic_map: Sequence[str],
    form: ReportFormat,
    report: Path | None,
    systems: Sequence[Path],
    message_folders: Sequence[Path],
) -> None:
    """Read the recordings, and print their coverage and the margins of thresholds. Write a `report`
    of the coverage as JSON.
    """
    with output.answering(form, "coverage", files=1 + len(recordings)) as answer:
        pairs = topic_pairs(topic_map)
        if report is not None:
            refuse_report(report, (rules, *recordings))
            output.try_file(report)
        with refusing(), reported_progress("moving thresholds") as on_progress:
            found = cover_recordings(
                rules,
                recordings,
                topic_map=pairs,
                systems=systems,
                message_folders=message_folders,
                on_progress=on_progress,
            )
        output.print_findings(found.findings)
        if not answer.is_printed:
            write_coverage(found.coverage, sys.stdout, found.reasons)
            typer.echo()
            write_margins(found.coverage.machine, found.margins, sys.stdout)
        if report is None and not answer.is_printed:
            return
        text = _report_text(found, rules, recordings)
        answer.result = json.loads(text)
        if report is not None:
            output.save(report, text)
            output.tell_written(report)


def _report_text(found: Exercised, rules: Path, recordings: Sequence[Path]) -> str:
    try:
        return coverage_report(found, rules, recordings, version=output.own_version())
    except OSError as error:
        output.fail(f"cannot read a recording again: {reason(error)}", exit_code=2)


def tests_result(tested: RanTests) -> Json:
    """Each test, and the common coverage of all tests. Lengths are in s."""
    return {
        "engines": ["interpreter", "c"] if tested.has_c else ["interpreter"],
        "tests": [
            {"name": ran.script.name, "passed": not ran.found, "seconds": round(ran.seconds, 3)}
            for ran in tested.ran
        ],
        "coverage": [asdict(each) for each in coverage_results(tested.coverage, tested.reasons)],
    }
