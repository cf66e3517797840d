"""The curves of trainings: the median over the seeds, and the quartiles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from dslkit.campaign import Value
from heron.evaluation.learning.trainings import Trainings, number
from heron.evaluation.plots import drawn
from heron.learning.arms import ARM_NAMES
from heron.learning.summary import CURVES, bins_of
from heron.variants import LearningArm

_COLORS: Mapping[LearningArm, str] = {
    LearningArm.UNGUARDED: "#7a7a7a",
    LearningArm.ENDED: "#2e7d4f",
    LearningArm.PENALTY: "#d1690f",
    LearningArm.GUARD: "#1f6fb4",
    LearningArm.GUARD_FEEDBACK: "#7d4fb0",
    LearningArm.EXECUTED: "#b0305f",
}
_TITLES: Mapping[str, str] = {
    "inserted": "insertions (% of episodes)",
    "violating": "with a violation (% of episodes)",
    "intervened": "proposed outside the rules (% of steps)",
}
_WIDTH = 3.2


def curves_of(found: Trainings) -> bytes:
    """Three axes over the steps of a training, as SVG."""

    def fill(grid: Any) -> None:
        for axes, name in zip(grid[0], CURVES, strict=True):
            for arm in found.arms:
                _add(axes, found, arm, name)
            axes.set_title(_TITLES[name], fontsize=8)
            axes.set_xlabel("steps (thousands)")
            axes.set_ylim(0, 103)
        grid[0][-1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)

    return drawn(1, len(CURVES), fill, width=_WIDTH)


def _add(axes: Axes, found: Trainings, arm: LearningArm, name: str) -> None:
    count = bins_of(found.formulation, found.budget)
    places = (np.arange(count) + 0.5) / count * found.budget / 1000
    values = _binned(found.of(arm), name, count)
    known = ~np.isnan(values).all(axis=0)
    low, middle, high = np.nanpercentile(values[:, known], (25, 50, 75), axis=0)
    axes.plot(places[known], middle, color=_COLORS[arm], label=ARM_NAMES[arm], linewidth=1.4)
    if len(values) > 1:
        axes.fill_between(places[known], low, high, color=_COLORS[arm], alpha=0.15, linewidth=0)


def _binned(rows: Sequence[Value], name: str, count: int) -> Any:
    """In percent, one row for each training; NaN where no episode ended."""
    cells = [[number(row[f"{name}_{place:02}"]) for place in range(count)] for row in rows]
    return 100 * np.array([[np.nan if one is None else one for one in row] for row in cells])
