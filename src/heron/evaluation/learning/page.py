"""The page of the study of learning, in Markdown. Every figure on it is computed from the rows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib.resources import files

from heron.evaluation.claim import Claim, Verdict, between
from heron.evaluation.learning.expectations import expectations_of
from heron.evaluation.learning.measures import MEASURES, Measure
from heron.evaluation.learning.names import ALGORITHM_NAMES, TITLES
from heron.evaluation.learning.reasons import REASONS
from heron.evaluation.learning.trainings import Trainings
from heron.evaluation.statistics import Estimate, median
from heron.learning.arms import ARM_NAMES
from heron.variants import LearningArm


def page_of(all_trainings: Sequence[Trainings], plots: str) -> str:
    """The whole page. `plots` is the folder of the pictures as seen from the page."""
    head = files("heron.evaluation").joinpath("assets/learning.md").read_text("utf-8")
    lines = [head, *_summary(all_trainings)]
    for found in all_trainings:
        lines += _section(found, plots)
    return "\n".join(lines)


def name_of(found: Trainings) -> str:
    """The name of files of these trainings."""
    return f"{found.formulation.value}-{found.algorithm}-{found.budget}"


def _title(found: Trainings) -> str:
    return f"{TITLES[found.formulation]}, by {ALGORITHM_NAMES[found.algorithm]}"


def _summary(all_trainings: Sequence[Trainings]) -> Iterator[str]:
    told = [(found, claim) for found in all_trainings for claim in expectations_of(found)]
    yield "## What came out"
    yield ""
    yield f"Of {len(told)} expectations:"
    yield ""
    for verdict in Verdict:
        count = sum(claim.verdict is verdict for _, claim in told)
        if count:
            yield f"- {count} came out {verdict.value}"
    yield ""
    for verdict in (Verdict.FAILS, Verdict.OPEN):
        chosen = [(found, claim) for found, claim in told if claim.verdict is verdict]
        if chosen:
            yield f"{verdict.value.capitalize()}:"
            yield ""
            yield from (_told(found, claim) for found, claim in chosen)
            yield ""


def _told(found: Trainings, claim: Claim) -> str:
    reason = REASONS.get((found.formulation.value, found.algorithm, claim.key))
    why = f" {reason}" if reason and claim.verdict is Verdict.FAILS else ""
    return f"- *{_title(found)}*, {claim.expected}: {claim.found}.{why}"


def _section(found: Trainings, plots: str) -> Iterator[str]:
    title = _title(found)
    yield f"## {title[0].upper()}{title[1:]}"
    yield ""
    seeds = {arm: len(found.of(arm)) for arm in found.arms}
    few, many = min(seeds.values()), max(seeds.values())
    count = f"{few}" if few == many else f"{few} to {many}"
    yield f"Seeds: {count}. Steps of a training: {found.budget:,}."
    yield ""
    yield f"![{title}: curves of all arms]({plots}/{name_of(found)}.svg)"
    yield ""
    yield f"| | {' | '.join(ARM_NAMES[arm] for arm in found.arms)} |"
    yield f"|---|{'---|' * len(found.arms)}"
    for measure in MEASURES:
        cells = " | ".join(_cell(found, arm, measure) for arm in found.arms)
        yield f"| {measure.label} | {cells} |"
    yield ""
    yield "| expected | found | |"
    yield "|---|---|---|"
    for claim in expectations_of(found):
        yield f"| {claim.expected} | {claim.found} | {claim.verdict.value} |"
    yield ""


def _cell(found: Trainings, arm: LearningArm, measure: Measure) -> str:
    values = found.values(arm, measure.name)
    if not values:
        return "-"
    text = between(_scaled(median(values), 100 if measure.is_share else 1), measure.digits)
    total = len(found.of(arm))
    return text if len(values) == total else f"{text}, of {len(values)}"


def _scaled(found: Estimate, factor: float) -> Estimate:
    return Estimate(factor * found.value, factor * found.low, factor * found.high)
