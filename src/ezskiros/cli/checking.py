"""Checks for commands: user code runs in a child process, and this process prints the findings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from dslkit.diagnostics import Collector, Diagnostic, Severity
from dslkit.extensions import extension
from dslkit.options import Format
from dslkit.writing import reason
from ezskiros.cli.output import output

if TYPE_CHECKING:  # imported late, because users wait for imports
    from ezskiros.confinement import Report
    from ezskiros.learning.lessons import Lessons

Work = Callable[[Collector], Any]


def reported(work: Work, seconds: float = 0.0, *, may_act: bool = False) -> Report:
    """Run work that executes users' code, and return its report. The run ends if the work refuses
    its task.

    `seconds` is the additional time that a step may take compared with a step of a check. The
    findings are not printed.
    """
    from ezskiros import confinement
    from ezskiros.confinement.report import PATIENCE_S
    from ezskiros.driver import UnknownSkillError

    def refusing(collector: Collector) -> Any:
        try:
            return work(collector)
        except UnknownSkillError as problem:
            raise confinement.RefusedError(str(problem)) from None
        except ModuleNotFoundError as problem:
            if advice := output.extras().explained(problem):
                raise confinement.RefusedError(advice) from None
            raise

    report = confinement.confined(refusing, PATIENCE_S + seconds, may_act=may_act)
    if report.unconfined is not None:
        output.complain(f"this check runs code without confinement: {report.unconfined}")
    if report.refused is not None:
        errors = [each for each in report.diagnostics if each.severity is Severity.ERROR]
        output.print_findings(errors)
        output.fail(report.refused, exit_code=2)
    return report


def asked(work: Work, seconds: float = 0.0, *, may_act: bool = False) -> tuple[Any, Report]:
    """The result of the work. If the work did not complete, print the findings and end the run."""
    report = reported(work, seconds, may_act=may_act)
    if report.value is None:
        output.reject(report.diagnostics)
    return report.value, report


def checked(
    paths: Sequence[Path], values: Path | None = None, lessons: Lessons | None = None
) -> Report:
    """Check files, and return the report, whose value is the number of files. Findings of `lessons`
    about skills are included.
    """
    from ezskiros.driver import check_paths

    if values is not None:  # before the child starts, which seals the imported modules
        import ezskiros.trees.launch
    if lessons is not None:
        import ezskiros.learning.findings  # noqa: F401

    def work(collector: Collector) -> int:
        found = check_paths(paths, values, collector)
        if lessons is not None:
            from ezskiros.learning.findings import findings

            collector.extend(findings(lessons, found.library))
        return len(found.files)

    return reported(work)


def lessons_of(knowledge: Path | None) -> tuple[Lessons | None, Sequence[Diagnostic]]:
    """The lessons in a file, and the reason why there are none. The run ends if the file cannot be
    read.
    """
    if knowledge is None:
        return None, ()
    from ezskiros.learning.knowledge import read_knowledge

    try:
        found = read_knowledge(knowledge)
    except OSError as problem:
        output.fail(f"cannot read {knowledge}: {reason(problem)}", exit_code=2)
    return (None, [found]) if isinstance(found, Diagnostic) else (found.lessons, ())


def print_check(
    paths: Sequence[Path],
    values: Path | None,
    form: Format,
    rules: Path | None = None,
    knowledge: Path | None = None,
    study: Path | None = None,
) -> int:
    """Check, print the findings, and return the exit code.

    With `rules`, the findings of rules and skills together are included; with `knowledge`, the
    findings of recorded runs about the skills. With `study`, the findings are also appended to a
    study log.
    """
    with output.answering(form, "check", files=len(paths)):
        together = None if rules is None else _looking_at_both()
        lessons, wrong = lessons_of(knowledge)
        report = checked(paths, values, lessons)
        found = (
            *report.diagnostics,
            *(together(rules) if together is not None else ()),
            *wrong,
        )
        if study is not None:
            from ezskiros.skills.load import module_files

            output.log_study(study, "check", module_files(paths), found)
        output.print_diagnostics(found, form, file_count=file_count(report, paths))
        return output.exit_code(found)


def _looking_at_both() -> Callable[[Path | None], Sequence[Diagnostic]]:
    """The joint check of rules and skills, from the package crosscheck."""
    found = extension("ezskiros.check", "rules")
    if found is None:
        advice = output.extras().advice("rules")
        output.fail(f"`--rules` needs the package crosscheck: {advice}", exit_code=2)
    return found


def file_count(report: Report, paths: Sequence[Path]) -> int:
    """The number of files in a report."""
    from ezskiros.skills.load import module_files

    return report.value if isinstance(report.value, int) else len(module_files(paths))
