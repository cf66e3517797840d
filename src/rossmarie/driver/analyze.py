"""All findings on a rules file: those of the check, and those of the queries about its rules."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from dslkit.diagnostics import Collector, Diagnostic
from dslkit.source import Span
from dslkit.writing import write_whole
from rossmarie.analysis.finding import Finding
from rossmarie.analysis.unproved import without_solver
from rossmarie.analysis.witness import Witness
from rossmarie.check.instances.telling import reported
from rossmarie.driver.pipeline import Compiled, RulesError, check_file, compile_checked
from rossmarie.extras import EXTRAS
from rossmarie.ir import Category, Machine

TOGGLE_NS = 1_000_000_000
"""The default time in ns within which a rule may not toggle."""


@dataclass(frozen=True)
class Analysis:
    """All findings on a rules file, and the witnesses as recordings (CSV), by file name. The rules
    are the queried rules; None if no query ran. `proved` are the spans of the requirements that
    were proved.
    """

    findings: tuple[Finding, ...]
    witnesses: dict[str, str]
    compiled: Compiled | None = None
    proved: frozenset[Span] = frozenset()

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """The findings without their witnesses."""
        return tuple(finding.diagnostic for finding in self.findings)


def analyze_file(
    rules: Path,
    *,
    thorough: bool = False,
    toggle_ns: int = TOGGLE_NS,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
    only: Sequence[Category] = (),
    on_step: Callable[[str], None] = lambda _: None,
) -> Analysis:
    """Check a rules file, and run the quick queries about its rules, or all queries. `on_step` is
    called with the name of each query.

    No query runs on a file with errors, or on a file that no target can run.
    """
    result = check_file(rules, systems=systems, message_folders=message_folders, only=only)
    without_answers = Analysis(tuple(map(Finding, result.diagnostics)), {})
    if result.program is None or not result.program.rules:
        return without_answers
    try:
        compiled = compile_checked(result, message_folders)
    except RulesError:
        return without_answers
    if EXTRAS.missing("solver"):
        return _without_solver(compiled, result.diagnostics)
    found = analyzed(compiled, result.diagnostics, rules, thorough, toggle_ns, on_step)
    return replace(found, compiled=compiled)


def _without_solver(compiled: Compiled, checked: Sequence[Diagnostic]) -> Analysis:
    """The findings of an environment without z3, `checked` among them."""
    asked = without_solver(compiled.machine, compiled.requirements, EXTRAS.advice("solver"))
    found = reported([each.diagnostic for each in asked], compiled.instances)
    return Analysis(tuple(map(Finding, (*checked, *found))), {}, compiled=compiled)


def analyzed(
    compiled: Compiled,
    checked: tuple[Diagnostic, ...],
    rules: Path,
    thorough: bool = False,
    toggle_ns: int = TOGGLE_NS,
    on_step: Callable[[str], None] = lambda _: None,
) -> Analysis:
    """Run the queries about rules. `checked` are the findings so far."""
    from rossmarie.analysis.errors import InTime
    from rossmarie.analysis.witness import as_csv, within

    collector = Collector()
    collector.extend(checked)
    witnesses: dict[str, str] = {}
    shown: dict[int, Witness] = {}
    proved: set[Span] = set()
    for asked, finding in _answers(compiled, thorough, toggle_ns, on_step):
        if _is_reported(compiled.machine, finding.diagnostic, checked):
            continue
        if finding.diagnostic.code == InTime.code:
            proved.add(finding.diagnostic.primary.span)
            if not thorough:
                continue
        (diagnostic,) = reported((finding.diagnostic,), compiled.instances)
        collector.add(diagnostic)
        if finding.witness is not None:
            shown[id(diagnostic)] = within(compiled.machine, finding.witness)
            code = diagnostic.code
            count = sum(code in name for name in witnesses) + 1
            name = f"{rules.stem}_{code}_{count}.csv"
            witnesses[name] = as_csv(asked, finding.witness)
    findings = tuple(Finding(each, shown.get(id(each))) for each in collector.sorted())
    return Analysis(findings, witnesses, proved=frozenset(proved))


def _answers(
    compiled: Compiled, thorough: bool, toggle_ns: int, on_step: Callable[[str], None]
) -> Iterator[tuple[Machine, Finding]]:
    """Each finding with the machine that the finding is about."""
    from rossmarie.analysis.queries import ask_all, ask_required  # importing the solver is slow

    machine = compiled.machine
    for found in ask_all(machine, thorough=thorough, within_ns=toggle_ns, on_step=on_step):
        yield machine, found
    for required in compiled.requirements:
        for found in ask_required(required, thorough=thorough, on_step=on_step):
            yield required.machine, found


def _is_reported(machine: Machine, found: Diagnostic, checked: Sequence[Diagnostic]) -> bool:
    """Say whether the check has already reported that nothing clears a rule (ROSS408)."""
    if found.code != "ROSS707":
        return False
    rule = next(rule for rule in machine.rules if rule.head == found.primary.span)
    return any(each.code == "ROSS408" and rule.span.contains(each.primary.span) for each in checked)


def write_witnesses(analysis: Analysis, folder: Path) -> list[Path]:
    """Write the witnesses into a folder, for `rossmarie replay`. Raises `OSError`."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in analysis.witnesses.items():
        write_whole(folder / name, text)
    return [folder / name for name in analysis.witnesses]
