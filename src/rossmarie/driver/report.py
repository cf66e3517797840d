"""The safety report: it makes a safety file from a rules file and the reports on the rules."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from dslkit.writing import reason
from rossmarie.driver.analyze import analyzed
from rossmarie.driver.pipeline import CheckResult, check_file, compile_checked
from rossmarie.driver.sources import name_of
from rossmarie.ir import Category
from rossmarie.report.safety import (
    DeclaredItem,
    Evidence,
    EvidenceKind,
    RulesFile,
    SafetyFile,
    parse_evidence,
)
from rossmarie.report.safety.errors import (
    EvidenceError,
    EvidenceOfOtherRules,
    EvidenceUnreadable,
    at_file,
)
from rossmarie.report.safety.evidence import Hashed
from rossmarie.syntax import ast


def safety_file(
    rules: Path,
    *,
    tool: str,
    date: str,
    verification: Path | None = None,
    coverage: Path | None = None,
    thorough: bool = False,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
    only: Sequence[Category] = (),
) -> tuple[SafetyFile, tuple[Diagnostic, ...]]:
    """The safety file, and the findings on the rules and the reports.

    `tool` is the program with its version, `date` the date on the file. With `thorough`, all
    queries about the rules run. Raises `RulesError`, and `EvidenceError` for a report that cannot
    be used.
    """
    from rossmarie.analysis.failures import losses  # importing the solver is slow
    from rossmarie.analysis.inquiry import Inquiry

    result = check_file(rules, systems=systems, message_folders=message_folders, only=only)
    compiled = compile_checked(result, message_folders)
    reports = {
        kind: _evidence(kind, path)
        for kind, path in (
            (EvidenceKind.VERIFICATION, verification),
            (EvidenceKind.COVERAGE, coverage),
        )
        if path is not None
    }
    analysis = analyzed(compiled, compiled.warnings, rules, thorough)
    content = SafetyFile(
        machine=compiled.machine,
        rules_file=rules.name,
        sources=tuple(
            RulesFile(name_of(Path(file.path), rules), file, file.sha256)
            for file in compiled.sources
        ),
        constants=tuple(_constants(result)),
        priorities=tuple(_priorities(result)),
        findings=analysis.findings,
        is_thorough=thorough,
        losses=tuple(losses(Inquiry(compiled.machine))),
        requirements=compiled.requirements,
        proved=analysis.proved,
        tool=tool,
        date=date,
        verification=reports.get(EvidenceKind.VERIFICATION),
        coverage=reports.get(EvidenceKind.COVERAGE),
    )
    return content, (*analysis.diagnostics, *_strange(content, verification, coverage))


def _evidence(kind: EvidenceKind, path: Path) -> Evidence:
    try:
        content = path.read_bytes()
    except OSError as error:
        finding = EvidenceUnreadable(kind=kind.value, reason=reason(error))
        raise EvidenceError(at_file(finding, path)) from None
    return parse_evidence(content, kind, path)


def _strange(
    content: SafetyFile, verification: Path | None, coverage: Path | None
) -> Iterator[Diagnostic]:
    """Warnings about reports that belong to another text of the rules."""
    for path, evidence in ((verification, content.verification), (coverage, content.coverage)):
        if path is None or evidence is None:
            continue
        missing = evidence.missing(Hashed(each.name, each.sha256) for each in content.sources)
        if missing:
            kind = evidence.kind
            files = ", ".join(f"`{name}`" for name in missing)
            finding = EvidenceOfOtherRules(kind=kind.value, files=files)
            yield at_file(finding, path)


# --- the declarations of the rules -------------------------------------------------------


def _constants(result: CheckResult) -> Iterator[DeclaredItem]:
    for module in result.modules:
        for item in module.items:
            if isinstance(item, ast.Constant):
                text = " ".join(item.value.span.text.split())
                yield DeclaredItem(item.name.text, text, item.documentation, item.span)


def _priorities(result: CheckResult) -> Iterator[DeclaredItem]:
    for module in result.modules:
        for item in module.items:
            if isinstance(item, ast.Priority):
                text = " ".join(item.span.text.split())
                yield DeclaredItem("priority", text, None, item.span)
