"""The page of the study of learning, in Markdown. Every figure on it is computed from the rows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib.resources import files

from heron.evaluation.expectation import between
from heron.evaluation.learning.expectations import expectations_of
from heron.evaluation.learning.measures import MEASURES, MeasureColumn
from heron.evaluation.learning.names import ALGORITHM_NAMES, TITLES
from heron.evaluation.learning.reasons import REASONS
from heron.evaluation.learning.trainings import Trainings
from heron.evaluation.statistics import Estimate, median
from heron.evaluation.summary import ReportedExpectation, summary_of, table_of
from heron.learning.arms import ARM_NAMES
from heron.variants import LearningArm


def page_of(all_trainings: Sequence[Trainings], plots: str) -> str:
    """The whole page. `plots` is the folder of the pictures as seen from the page."""
    head = files("heron.evaluation").joinpath("assets/learning.md").read_text("utf-8")
    reported = [each for found in all_trainings for each in _reported(found)]
    lines = [head, *summary_of(reported)]
    for found in all_trainings:
        lines += _section(found, plots)
    return "\n".join(lines)


def name_of(found: Trainings) -> str:
    """The name of files of these trainings."""
    return f"{found.formulation.value}-{found.algorithm}-{found.budget}"


def _title(found: Trainings) -> str:
    return f"{TITLES[found.formulation]}, by {ALGORITHM_NAMES[found.algorithm]}"


def _reported(found: Trainings) -> Iterator[ReportedExpectation]:
    for expectation in expectations_of(found):
        reason = REASONS.get((found.formulation.value, found.algorithm, expectation.key))
        yield ReportedExpectation(_title(found), expectation, reason)


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
    yield from table_of(expectations_of(found))


def _cell(found: Trainings, arm: LearningArm, measure: MeasureColumn) -> str:
    values = found.values(arm, measure.name)
    if not values:
        return "-"
    text = between(_scaled(median(values), 100 if measure.is_share else 1), measure.digits)
    total = len(found.of(arm))
    return text if len(values) == total else f"{text}, of {len(values)}"


def _scaled(found: Estimate, factor: float) -> Estimate:
    return Estimate(factor * found.value, factor * found.low, factor * found.high)
