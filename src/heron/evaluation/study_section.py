"""The section of the page about a study: a table of all values, and the reason for the default
value.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from heron.evaluation.expectation import between
from heron.evaluation.rows import EpisodeRow, StudyRow
from heron.evaluation.statistics import median
from heron.experiments import Study
from heron.experiments.experiment import ARM_NAMES, COMPLETED, DURATION
from heron.experiments.studies import OPERATOR, TORQUE, Case
from heron.scene import BaseParameters, CourseParameters

_GRAVITY = 9.81


def section_of(
    study: Study,
    rows: Sequence[StudyRow],
    experiments: Mapping[str, Sequence[EpisodeRow]],
    plots: str,
) -> Iterator[str]:
    """Lines of Markdown; `experiments` are the rows of the episodes with the usual settings."""
    yield f"### {study.title}"
    yield ""
    yield _WORDS[study.name]
    yield ""
    seeds = {one.row.seed for one in rows}
    yield f"Seeds: {len(seeds)}. A cell shows the number of episodes that completed their task, and"
    yield "the median of their times (s) with its interval."
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


def _cell(rows: Sequence[EpisodeRow]) -> str:
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
The thesis states that a slope needs more torque than the robot usually has, but gives no number.
Each wheel needs {slope_torque():.1f} Nm to stand on the gentle slope, and little torque on level
ground. We chose {BaseParameters().torque:.0f} Nm as the usual limit. Below the torque that the
slope needs, the base stalls, so rules have a hazard to recover from. Slightly above that torque,
the base climbs slowly. With still more torque this hazard does not exist: a robot without a monitor
arrives, and arrives sooner than a robot with rules, because the rules slow the robot down on the
bump.""",
    OPERATOR.name: """\
In the DeROS arm, an operator has to come. Half a minute is our choice, and this choice determines
most of the times of DeROS. With 0 s, the operator always stands beside the robot. After each stop,
the operator drives the robot over the hazard or away from the hazard by hand, which takes time too.
Compare these times with the last row.""",
}
