"""The report of an analysis, in Markdown."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from study_kit.analysis import MEASURES, Analysis
from study_kit.records import JUDGEMENTS, Study
from study_kit.statistics import LEVEL, RESAMPLES, Difference, Estimate


def report(study: Study, found: Analysis) -> str:
    """The report as Markdown."""
    return "\n".join(_lines(study, found)) + "\n"


def _lines(study: Study, found: Analysis) -> Iterator[str]:
    people = {each.participant for each in study.attempts}
    yield "# Results of the study"
    yield ""
    yield f"Participants: {len(people)}. Sessions: {len(study.attempts)}."
    yield f"Intervals: {LEVEL:.0%}, BCa bootstrap with {RESAMPLES} resamples over participants."
    yield from _to_judge(found)
    yield from _table(
        "By condition",
        ("measure", "condition", "participants", "mean", "interval"),
        [
            (MEASURES[measure], condition, str(each.count), f"{each.value:.2f}", _interval(each))
            for (measure, condition), each in sorted(found.measures.items())
        ],
    )
    yield from _table(
        "Comparisons",
        ("measure", "conditions", "difference", "interval", "p", "p adjusted"),
        [
            (
                MEASURES[each.measure],
                f"{each.ours} minus {each.plain}",
                f"{each.difference.value:+.2f}",
                _interval(each.difference),
                f"{each.difference.p:.4f}",
                f"{each.p_adjusted:.4f}",
            )
            for each in found.comparisons
        ],
    )
    yield ""
    yield "The p-values come from permutation tests over participants, which are exact for small"
    yield "groups. `p adjusted` controls the false discovery rate over all comparisons."
    yield from _table(
        "Planted faults",
        ("condition", "fault", "sessions", "found", "fixed", "median time to a fix in s"),
        [
            (
                *map(str, (line.condition, line.fault, line.sessions, line.found, line.fixed)),
                _seconds(line.median_s),
            )
            for line in found.faults
        ],
    )
    yield from _table(
        "Findings by code",
        ("code", "findings", "vanished", "came back", "median time to vanish in s"),
        [
            (
                line.code,
                str(line.count),
                str(line.vanished),
                str(line.came_back),
                _seconds(line.median_s),
            )
            for line in found.codes
        ],
    )
    yield from _table(
        "Opinions",
        ("opinion", "condition", "1 (strongly disagree)", "2", "3", "4", "5 (strongly agree)"),
        [
            (name, condition, *map(str, counts))
            for (name, condition), counts in sorted(found.opinions.items())
        ],
    )


def _to_judge(found: Analysis) -> Iterator[str]:
    if found.to_judge:
        yield ""
        yield f"Faults to judge in {JUDGEMENTS}, which count as missed until then:"
        yield ""
        yield from (f"- {each}" for each in found.to_judge)


def _table(title: str, head: Sequence[str], rows: Sequence[Sequence[str]]) -> Iterator[str]:
    if not rows:
        return
    yield ""
    yield f"## {title}"
    yield ""
    yield f"| {' | '.join(head)} |"
    yield "|" + "---|" * len(head)
    for row in rows:
        yield f"| {' | '.join(row)} |"


def _interval(each: Estimate | Difference) -> str:
    if each.low is None or each.high is None:
        return "none"
    return f"{each.low:.2f} to {each.high:.2f}"


def _seconds(value: float | None) -> str:
    return "none" if value is None else f"{value:.0f}"
