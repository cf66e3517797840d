"""The plots of an evaluation: every episode a dot, the median a line."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heron.evaluation.sample import Sample
from heron.experiments import Measure
from heron.experiments.table import ARM_NAMES, DURATION
from heron.variants import Arm

_COLORS = {Arm.NONE: "#7a7a7a", Arm.DEROS: "#d1690f", Arm.ROSSMARIE: "#1f6fb4"}
_WIDTH, _HEIGHT = 2.2, 2.0
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
    with mpl.rc_context(_STYLE):
        figure = Figure(figsize=(_WIDTH * columns, _HEIGHT * len(chosen)), layout="constrained")
        grid = figure.subplots(len(chosen), columns, squeeze=False)
        for axes_of_row, sample in zip(grid, chosen, strict=True):
            _fill(list(axes_of_row), sample)
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
    for place, arm in enumerate(Arm):
        values = sample.values(arm, measure.name)
        spread = np.linspace(-0.25, 0.25, len(values)) if len(values) > 1 else [0.0]
        axes.plot(
            place + np.asarray(spread), values, "o", color=_COLORS[arm], markersize=2.5, alpha=0.6
        )
        axes.hlines(float(np.median(values)), place - 0.35, place + 0.35, color=_COLORS[arm])
    axes.set_title(f"{measure.label} ({measure.unit})", fontsize=8)
    axes.set_xticks(range(len(Arm)), [ARM_NAMES[arm] for arm in Arm])
    axes.set_ylim(bottom=0)
