"""The figure of a study: the share of unfixed faults over time, and the SUS scores."""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path

import matplotlib as mpl
from matplotlib.figure import Figure

from study_kit import statistics
from study_kit.faults import CONDITIONS
from study_kit.records import Outcome, Study


def draw(study: Study, path: Path) -> None:
    """Write the figure as SVG: one panel for each task, and one for the SUS scores."""
    with mpl.rc_context({"svg.hashsalt": "study"}):
        figure = Figure(figsize=(12, 4), layout="constrained")
        rules, skills, sus = figure.subplots(1, 3)
        _draw_faults(rules, study, "rules")
        _draw_faults(skills, study, "skills")
        _draw_scores(sus, study)
        figure.savefig(path, metadata={"Date": None})


def _draw_faults(axes: mpl.axes.Axes, study: Study, task: str) -> None:
    outcomes: dict[str, list[Outcome]] = defaultdict(list)
    for each in study.attempts:
        if each.task == task:
            outcomes[each.condition] += each.outcomes
    for condition, found in sorted(outcomes.items()):
        times, left = statistics.survival(
            [each.seconds for each in found], [each.is_fixed for each in found]
        )
        axes.step([each / 60 for each in times], left, where="post", label=condition)
    axes.set(
        title=f"Task: {task}",
        xlabel="time in the session (min)",
        ylabel="share of planted faults not fixed",
        ylim=(0, 1.02),
    )
    if outcomes:
        axes.legend()


def _draw_scores(axes: mpl.axes.Axes, study: Study) -> None:
    names = [name for name in CONDITIONS if any(each.condition == name for each in study.answers)]
    for at, name in enumerate(names):
        scores = [each.score for each in study.answers if each.condition == name]
        axes.plot([at] * len(scores), scores, "o", color="tab:gray", alpha=0.5)
        mean = statistics.mean(scores)
        axes.plot(at, mean.value, "s", color="tab:blue")
        if mean.low is not None and mean.high is not None:
            axes.vlines(at, mean.low, mean.high, color="tab:blue")
    axes.set(title="SUS scores, means and intervals", ylim=(0, 100), ylabel="SUS score")
    axes.set_xticks(range(len(names)), names)
