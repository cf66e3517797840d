"""The first section of a page: how many expectations came out, and which did not."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from heron.evaluation.claim import Claim, Verdict


class Told(NamedTuple):
    """An expectation, the experiment or training that it is of, and why it came out otherwise, if
    that is known.
    """

    place: str
    claim: Claim
    reason: str | None


def summary_of(all_told: Sequence[Told]) -> Iterator[str]:
    """The lines of the section."""
    yield "## What came out"
    yield ""
    yield f"Of {len(all_told)} expectations:"
    yield ""
    for verdict in Verdict:
        count = sum(told.claim.verdict is verdict for told in all_told)
        if count:
            yield f"- {count} came out {verdict.value}"
    yield ""
    for verdict in (Verdict.FAILS, Verdict.OPEN):
        chosen = [told for told in all_told if told.claim.verdict is verdict]
        if chosen:
            yield f"{verdict.value.capitalize()}:"
            yield ""
            yield from map(_line, chosen)
            yield ""


def table_of(claims: Iterable[Claim]) -> Iterator[str]:
    """The expectations of an experiment or training, as a table."""
    yield "| expected | found | |"
    yield "|---|---|---|"
    for claim in claims:
        yield f"| {claim.expected} | {claim.found} | {claim.verdict.value} |"
    yield ""


def _line(told: Told) -> str:
    claim = told.claim
    why = f" {told.reason}" if told.reason and claim.verdict is Verdict.FAILS else ""
    return f"- *{told.place}*, {claim.expected}: {claim.found}.{why}"
