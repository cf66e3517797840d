"""The first section of a page: the number of expectations that were met, and the list of the
others.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from heron.evaluation.expectation import ExpectationVerdict, ResultExpectation

_EXPLAINED = {ExpectationVerdict.OPEN: " (the runs are not enough to decide)"}
"""The explanation of a verdict, if its word is not enough."""


class ReportedExpectation(NamedTuple):
    """An expectation with its experiment or training. If an expectation is not met, and the reason
    is known, there is a reason.
    """

    place: str
    expectation: ResultExpectation
    reason: str | None


def summary_of(all_reported: Sequence[ReportedExpectation]) -> Iterator[str]:
    """The lines of the section."""
    yield "## Expectations"
    yield ""
    yield f"The runs test {len(all_reported)} expectations:"
    yield ""
    for verdict in ExpectationVerdict:
        count = sum(reported.expectation.verdict is verdict for reported in all_reported)
        if count:
            yield f"- {verdict.value}{_EXPLAINED.get(verdict, '')}: {count}"
    yield ""
    for verdict in (ExpectationVerdict.FAILS, ExpectationVerdict.OPEN):
        chosen = [reported for reported in all_reported if reported.expectation.verdict is verdict]
        if chosen:
            yield f"{verdict.value.capitalize()}:"
            yield ""
            yield from map(_line, chosen)
            yield ""


def table_of(expectations: Iterable[ResultExpectation]) -> Iterator[str]:
    """The expectations of an experiment or training, as a table."""
    yield "| expected | found | verdict |"
    yield "|---|---|---|"
    for expectation in expectations:
        yield f"| {expectation.expected} | {expectation.found} | {expectation.verdict.value} |"
    yield ""


def _line(reported: ReportedExpectation) -> str:
    expectation = reported.expectation
    why = (
        f" {reported.reason}"
        if reported.reason and expectation.verdict is ExpectationVerdict.FAILS
        else ""
    )
    return f"- *{reported.place}*, {expectation.expected}: {expectation.found}.{why}"
