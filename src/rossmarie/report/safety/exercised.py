"""The coverage of rules by traces as the results of a report: one for each row of the table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rossmarie.report.coverage import counted, missing, queries
from rossmarie.report.safety.evidence import AnsweredQuery, EvidenceKind
from rossmarie.testing.coverage import Coverage
from rossmarie.testing.goals import TraceGoal


def coverage_results(
    coverage: Coverage, reasons: Mapping[TraceGoal, str]
) -> Iterator[AnsweredQuery]:
    """The rows, rule by rule. `reasons` maps goals to the reasons why they cannot be reached."""
    covered, not_covered = EvidenceKind.COVERAGE.statuses
    for rule, declared in enumerate(coverage.machine.rules):
        for text, goals in queries(coverage, rule):
            left = missing(coverage, goals, reasons)
            seen = f"{counted(coverage, goals)} seen"
            yield AnsweredQuery(
                name=f"{declared.name}: {text}",
                status=not_covered if left else covered,
                detail=f"{seen}; not seen: {left}" if left else seen,
            )
