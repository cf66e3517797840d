"""The section of the page about a study: a table of all values, and the reason for the default
value.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from heron.evaluation.expectation import between
from heron.evaluation.rows import Row, StudyRow
from heron.evaluation.statistics import median
from heron.experiments import Study
from heron.experiments.experiment import ARM_NAMES, COMPLETED, DURATION
from heron.experiments.studies import OPERATOR, TORQUE, Case
from heron.scene import BaseParameters, CourseParameters

_GRAVITY = 9.81


def section_of(
    study: Study,
    rows: Sequence[StudyRow],
    experiments: Mapping[str, Sequence[Row]],
    plots: str,
) -> Iterator[str]:
    """Lines of Markdown; `experiments` are the rows of the episodes with the usual settings."""
    yield f"### {study.title}"
    yield ""
    yield _WORDS[study.name]
    yield ""
    seeds = {one.row.seed for one in rows}
    yield f"Seeds: {len(seeds)}. A cell is how many episodes completed their task, and the median"
    yield "of their times (s) with its interval."
    yield ""
    yield f"| {study.label} ({study.unit}) | {' | '.join(_title(case) for case in study.cases)} |"
    yield f"|---|{'---|' * len(study.cases)}"
    for value in study.values:
        cells = " | ".join(
            _cell([one.row for one in of_case(rows, case, value)]) for case in study.cases
        )
        yield f"| {value:g} | {cells} |"
    if study.beside is not None:
        cells = " | ".join(
            _cell(
                [
                    row
                    for row in experiments.get(case.experiment, ())
                    if (row.variant, row.arm) == (case.variant.value, study.beside.value)
                    and row.seed in seeds
                ]
            )
            for case in study.cases
        )
        yield f"| {ARM_NAMES[study.beside]}, on the same seeds | {cells} |"
    yield ""
    yield f"![{study.title}]({plots}/{study.name}.svg)"
    yield ""


def of_case(rows: Sequence[StudyRow], case: Case, value: float) -> list[StudyRow]:
    """The episodes of a case at a value."""
    wanted = (value, case.experiment, case.variant.value, case.arm.value)
    return [
        one for one in rows if (one.value, one.experiment, one.row.variant, one.row.arm) == wanted
    ]


def _title(case: Case) -> str:
    return f"{case.of.title}, {case.variant.value}: {ARM_NAMES[case.arm]}"


def _cell(rows: Sequence[Row]) -> str:
    if not rows:
        return "-"
    done = sum(row.numbers[COMPLETED.name] > 0 for row in rows)
    times = median([row.numbers[DURATION.name] for row in rows])
    return f"{done} of {len(rows)}, {between(times, DURATION.digits)}"


def slope_torque() -> float:
    """The torque (Nm) that each of two wheels needs to hold the base on the gentle slope."""
    base, course = BaseParameters(), CourseParameters()
    return base.mass * _GRAVITY * math.sin(course.gentle) * base.wheel_radius / 2


_WORDS: Mapping[str, str] = {
    TORQUE.name: f"""\
The thesis says that a slope needs more torque than the robot usually gives, and not how much. Each
wheel needs {slope_torque():.1f} Nm to stand on the gentle slope, and little on the level. We chose
{BaseParameters().torque:.0f} Nm as the usual limit, so that the base stalls: below what the slope
needs there is a hazard for rules to recover from. Right above it the base crawls up. With more
there is no hazard of this kind: a robot without a monitor arrives, and sooner than one with rules,
which slow it down on the bump.""",
    OPERATOR.name: """\
In the arm of DeROS somebody has to come. Half a minute is our choice, and the times of DeROS are
mostly a matter of that choice. With 0 s the operator stands beside the robot all the time. He comes
for each stop, and drives the robot over the hazard or away from it by hand, which takes its time as
well. Compare with the last row.""",
}
