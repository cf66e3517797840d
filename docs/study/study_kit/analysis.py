"""The analysis of a study: by condition, by fault and by code, with comparisons of conditions."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from study_kit import statistics
from study_kit.records import OPINIONS, Attempt, Study
from study_kit.statistics import Difference, Estimate

COMPARED = (("rossmarie", "python"), ("rossmarie", "cpp"), ("ezskiros", "skiros2"))
"""The conditions that do the same task."""
MEASURES: Mapping[str, str] = {
    "fixed": "share of the faults fixed",
    "seconds": "mean time to a fix in s",
    "sus": "SUS score",
}


@dataclass(frozen=True)
class CodeLine:
    """The findings of one code: how many, how many vanished or came back, and for how long."""

    code: str
    count: int
    vanished: int
    came_back: int
    median_s: float | None


@dataclass(frozen=True)
class FaultLine:
    """One planted fault in one condition: in how many sessions it was found and fixed."""

    condition: str
    fault: str
    sessions: int
    found: int
    fixed: int
    median_s: float | None


@dataclass(frozen=True)
class Comparison:
    """One measure of two conditions; `p_adjusted` takes all comparisons of the study together."""

    measure: str
    ours: str
    plain: str
    difference: Difference
    p_adjusted: float


@dataclass(frozen=True)
class Analysis:
    """The figures of one study."""

    measures: Mapping[tuple[str, str], Estimate]
    comparisons: Sequence[Comparison]
    codes: Sequence[CodeLine]
    faults: Sequence[FaultLine]
    opinions: Mapping[tuple[str, str], Sequence[int]]
    to_judge: Sequence[str]


def analyse(study: Study) -> Analysis:
    """All figures of a study."""
    values = _values(study)
    return Analysis(
        measures={at: statistics.mean(each) for at, each in values.items() if each},
        comparisons=_comparisons(values),
        codes=list(_codes(study.attempts)),
        faults=list(_faults(study.attempts)),
        opinions=_opinions(study),
        to_judge=[
            f"{each.participant}, {each.condition}: {outcome.fault}"
            for each in study.attempts
            for outcome in each.outcomes
            if outcome.to_judge
        ],
    )


Values = Mapping[tuple[str, str], Sequence[float]]
"""One value for each participant, by measure and condition."""


def _values(study: Study) -> Values:
    found: dict[tuple[str, str], list[float]] = defaultdict(list)
    for each in study.attempts:
        count = len(each.outcomes)
        fixed = sum(outcome.is_fixed for outcome in each.outcomes)
        found["fixed", each.condition].append(fixed / count)
        seconds = sum(outcome.seconds for outcome in each.outcomes)
        found["seconds", each.condition].append(seconds / count)
    for answer in study.answers:
        found["sus", answer.condition].append(answer.score)
    return found


def _comparisons(values: Values) -> Sequence[Comparison]:
    found = []
    for measure in MEASURES:
        for ours, plain in COMPARED:
            first, second = values.get((measure, ours), ()), values.get((measure, plain), ())
            difference = statistics.difference(first, second)
            if difference is not None:
                found.append((measure, ours, plain, difference))
    adjusted = statistics.adjusted([each[-1].p for each in found])
    return [Comparison(*each, p) for each, p in zip(found, adjusted, strict=True)]


def _codes(attempts: Iterable[Attempt]) -> Iterable[CodeLine]:
    by_code = defaultdict(list)
    for attempt in attempts:
        for each in attempt.findings:
            by_code[each.code].append(each)
    for code, found in sorted(by_code.items()):
        yield CodeLine(
            code,
            count=len(found),
            vanished=sum(each.vanished for each in found),
            came_back=sum(each.came_back for each in found),
            median_s=statistics.median_time(
                [each.seconds for each in found], [each.vanished for each in found]
            ),
        )


def _faults(attempts: Iterable[Attempt]) -> Iterable[FaultLine]:
    by_fault = defaultdict(list)
    for attempt in attempts:
        for each in attempt.outcomes:
            by_fault[attempt.condition, each.fault].append(each)
    for (condition, fault), found in by_fault.items():
        yield FaultLine(
            condition,
            fault,
            sessions=len(found),
            found=sum(each.is_found for each in found),
            fixed=sum(each.is_fixed for each in found),
            median_s=statistics.median_time(
                [each.seconds for each in found], [each.is_fixed for each in found]
            ),
        )


def _opinions(study: Study) -> Mapping[tuple[str, str], Sequence[int]]:
    """The numbers of answers 1 to 5, by opinion and condition."""
    found: dict[tuple[str, str], list[int]] = {}
    for answer in study.answers:
        for name in OPINIONS:
            if name in answer.opinions:
                counts = found.setdefault((name, answer.condition), [0] * 5)
                counts[answer.opinions[name] - 1] += 1
    return found
