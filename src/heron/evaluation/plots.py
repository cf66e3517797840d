"""The plots of an evaluation: each episode is a dot, the median a line."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from io import BytesIO
from itertools import pairwise
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heron.evaluation.rows import StudyRow
from heron.evaluation.sample import Sample
from heron.evaluation.study_section import of_case
from heron.experiments import Measure, Study
from heron.experiments.experiment import ARM_NAMES, COMPLETED, DURATION
from heron.experiments.studies import Case
from heron.variants import ExperimentArm

_COLORS = {
    ExperimentArm.NONE: "#7a7a7a",
    ExperimentArm.COLLISION_MONITOR: "#2e7d4f",
    ExperimentArm.DEROS: "#d1690f",
    ExperimentArm.ROSSMARIE: "#1f6fb4",
    ExperimentArm.SKILL_AWARE: "#7d4fb0",
    ExperimentArm.PROACTIVE: "#0f8f8f",
    ExperimentArm.TREES: "#b5447a",
    ExperimentArm.LEARNED: "#8a7a0f",
}
_MARKERS = "os^Dv"
_WIDTH, _HEIGHT = 2.5, 2.3
_LETTERS = 30  # that a title has room for
_MOST_ARMS, _LETTERS_OF_TWO = 3, 16  # of more arms, the names of two have room for so many letters
_STYLE: Any = {
    "font.size": 8,
    "svg.hashsalt": "heron",  # the same rows give the same file
    "svg.fonttype": "none",
    "font.family": "sans-serif",
    "axes.spines.top": False,
    "axes.spines.right": False,
}


def plot_of(samples: Sequence[Sample]) -> bytes:
    """One row of axes for each variant with hazards, as SVG."""
    chosen = [sample for sample in samples if sample.harms]
    columns = 1 + max(len(sample.harms) for sample in chosen)

    def fill(grid: Any) -> None:
        for axes_of_row, sample in zip(grid, chosen, strict=True):
            _fill(list(axes_of_row), sample)

    return drawn(len(chosen), columns, fill)


def plot_of_study(study: Study, rows: Sequence[StudyRow]) -> bytes:
    """The share of completed tasks and their times over the values of the study, as SVG."""

    def fill(grid: Any) -> None:
        done, times = grid[0]
        for index, case in enumerate(study.cases):
            found = {value: each for value in study.values if (each := of_case(rows, case, value))}
            _add_line(done, case, index, found, COMPLETED, lambda values: 100 * np.mean(values))
            _add_line(times, case, index, found, DURATION, np.median)
        done.set_title("task completed (%)", fontsize=8)
        times.set_title(f"{DURATION.label} (s)", fontsize=8)
        for axes in (done, times):
            axes.set_xlabel(f"{study.label} ({study.unit})")
            axes.set_ylim(bottom=0)
        times.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)

    return drawn(1, 2, fill, width=3.6)


def drawn(rows: int, columns: int, fill: Callable[[Any], None], width: float = _WIDTH) -> bytes:
    """SVG of a grid of axes, each so wide (inch), that `fill` fills."""
    with mpl.rc_context(_STYLE):
        figure = Figure(figsize=(width * columns, _HEIGHT * rows), layout="constrained")
        fill(figure.subplots(rows, columns, squeeze=False))
        file = BytesIO()
        figure.savefig(file, format="svg", metadata={"Date": None})
    return file.getvalue()


def _fill(row: Sequence[Axes], sample: Sample) -> None:
    measures = [DURATION, *map(sample.experiment.measure, sample.harms)]
    for axes, measure in zip(row, measures, strict=False):
        _draw(axes, sample, measure)
    for axes in row[len(measures) :]:
        axes.set_axis_off()
    row[0].set_ylabel(sample.variant, fontweight="bold")


def _draw(axes: Axes, sample: Sample, measure: Measure) -> None:
    for place, arm in enumerate(sample.arms):
        values = sample.values(arm, measure.name)
        if not values:
            continue
        spread = np.linspace(-0.25, 0.25, len(values)) if len(values) > 1 else [0.0]
        axes.plot(
            place + np.asarray(spread), values, "o", color=_COLORS[arm], markersize=2.5, alpha=0.6
        )
        axes.hlines(float(np.median(values)), place - 0.35, place + 0.35, color=_COLORS[arm])
    title = textwrap.fill(measure.title, _LETTERS)
    axes.set_title(title, fontsize=8)
    names = [ARM_NAMES[arm].replace(" ", "\n") for arm in sample.arms]
    letters = [max(map(len, name.split())) for name in names]
    is_tight = len(names) > _MOST_ARMS and max(map(sum, pairwise(letters))) > _LETTERS_OF_TWO
    axes.set_xticks(range(len(names)), names, fontsize=5.5 if is_tight else 7)
    axes.set_ylim(bottom=0)


def _add_line(
    axes: Axes,
    case: Case,
    index: int,
    found: dict[float, list[StudyRow]],
    measure: Measure,
    middle: Callable[[list[float]], Any],
) -> None:
    values = [middle([one.row.numbers[measure.name] for one in each]) for each in found.values()]
    variant = f"{case.of.title}, {case.variant.value}: {ARM_NAMES[case.arm]}"
    axes.plot(list(found), values, marker=_MARKERS[index], markersize=4, label=variant)
