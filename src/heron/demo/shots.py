"""One episode of the demo."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from heron.demo.frames import DemoFrames, frames_of
from heron.experiments import EXPERIMENTS, EpisodeFacts, Experiment
from heron.films import Spans, film_of
from heron.films.processes import in_processes
from heron.tasks import TreeSkill
from heron.variants import ExperimentArm
from rossmarie.report.envelope import envelope
from rossmarie.report.model import Plot

_SAMPLES = 900
Curve = list[tuple[float, float]]


@dataclass(frozen=True)
class Shot:
    """Everything that leaves the process of the episode. Measures are as printed, by label."""

    experiment: str
    arm: ExperimentArm
    title: str
    is_completed: bool
    duration: float
    measures: dict[str, str]
    reported: tuple[tuple[float, str], ...]
    onsets: Mapping[str, float]
    rules: Spans
    tree: tuple[TreeSkill, ...]
    curves: dict[str, Curve]
    frames: DemoFrames


def shoot(name: str, variant: str, arm: ExperimentArm, seed: int) -> Shot:
    """Run an episode, and draw it."""
    experiment = EXPERIMENTS[name]
    clip = film_of(experiment, experiment.variants[variant], arm, seed)
    episode = clip.episode
    return Shot(
        experiment=name,
        arm=arm,
        title=experiment.describe(episode),
        is_completed=episode.measures.is_completed,
        duration=episode.measures.duration,
        measures=_measures(experiment, episode),
        reported=episode.reported,
        onsets=dict(episode.onsets),
        rules=clip.rules,
        tree=episode.tree,
        curves=_curves(experiment, episode),
        frames=frames_of(clip.film, experiment.cameras),
    )


def shoot_all(seed: int) -> list[Shot]:
    """The first variant of each experiment, in all of its arms."""
    wanted = [
        (name, next(iter(experiment.variants)), arm, seed)
        for name, experiment in EXPERIMENTS.items()
        for arm in experiment.arms
    ]
    return in_processes(shoot, wanted)


def _measures(experiment: Experiment, episode: EpisodeFacts) -> dict[str, str]:
    found = {one: one.of(episode.measures) for one in experiment.measures[1:]}
    texts = {one.label: one.text(value) for one, value in found.items() if value is not None}
    return {"task": "completed" if episode.measures.is_completed else "not completed", **texts}


def _curves(experiment: Experiment, episode: EpisodeFacts) -> dict[str, Curve]:
    trace = episode.trace
    curves = {}
    for signal in experiment.signals:
        values = trace.columns[signal.column] * signal.factor
        plot = Plot(signal.label, signal.unit, trace.times, values, ())
        times, kept = envelope(plot, _SAMPLES)
        curves[signal.label] = list(zip(times.tolist(), kept.tolist(), strict=True))
    return curves
