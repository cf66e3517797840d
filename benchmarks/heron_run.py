"""Measure the speed of the experiments and the cost of the guard; write the table as a page."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
from machine import processor
from written_page import written_page

from heron.experiments import EXPERIMENTS, USUAL, Experiment
from heron.guard import Guard
from heron.robot.physics import Floats, Physics
from heron.topics import InProcess
from heron.variants import ExperimentArm

ROUNDS = 15
BUDGET = 0.01
"""The target: the largest share of the CPU time of a run that the guard takes."""


class Laps:
    """An observer that records the CPU time of this process after each tenth of a second."""

    period_ns = 100_000_000

    def __init__(self) -> None:
        self.times = [time.process_time()]

    def attend(
        self,
        physics: Physics,  # noqa: ARG002
        carrier: InProcess,  # noqa: ARG002
        guard: Guard | None,  # noqa: ARG002
    ) -> list[Laps]:
        """Observe an episode; return the observers."""
        return [self]

    def tick(self, now_ns: int) -> None:  # noqa: ARG002
        """Record the CPU time; called each tenth of a second."""
        self.times.append(time.process_time())


@dataclass(frozen=True)
class Row:
    """The duration of a run (s), and its CPU time without and with the guard (s)."""

    title: str
    length: float
    without: float
    guarded: float

    @property
    def share(self) -> float:
        """The cost of the guard, relative to the run without the guard."""
        return (self.guarded - self.without) / self.without

    def __str__(self) -> str:
        cost = (self.guarded - self.without) / self.length
        return (
            f"| {self.title} | {self.length:.1f} s | {self.length / self.without:.1f} "
            f"| {self.length / self.guarded:.1f} | {1000 * cost:.2f} ms "
            f"| {100 * self.share:.1f} % |"
        )


def laps(experiment: Experiment, variant: str, arm: ExperimentArm) -> tuple[Floats, float]:
    """The CPU time of each tenth of a second of an episode, including its start and its end, and
    the duration of the episode (s).
    """
    noted = Laps()
    episode = experiment.run(arm, experiment.variants[variant], 0, [noted], USUAL)
    noted.times.append(time.process_time())
    return np.diff(noted.times), episode.measures.duration


def row(experiment: Experiment, variant: str) -> Row:
    """The minimum of each tenth of a second over the rounds. Runs with and without the guard take
    turns, so that other load on the machine affects both.
    """
    guarded_arm = experiment.arms[-1]  # the arm whose rules use the most inputs
    laps(experiment, variant, guarded_arm)  # compiles the rules
    rounds = [
        (laps(experiment, variant, ExperimentArm.NONE), laps(experiment, variant, guarded_arm))
        for _ in range(ROUNDS)
    ]
    lengths = {length for both in rounds for _, length in both}
    assert len(lengths) == 1, "without a hazard, both runs are the same"
    length = lengths.pop()
    without = float(np.min([plain for (plain, _), _ in rounds], axis=0).sum())
    guarded = float(np.min([guarded for _, (guarded, _) in rounds], axis=0).sum())
    return Row(f"{experiment.title}, {variant}", length, without, guarded)


PREFACE = """\
# Speed of the experiments

Written by `benchmarks/heron_run.py`; do not edit. All figures are CPU times of one process, on
{processor}. The times of a run are measured in parts of 0.1 s; each part
counts with its minimum of {rounds} rounds. Runs with and without the guard take turns.

The variants have no hazard, so the run is the same with and without the guard. The guard is in
the same process: the monitor and the reactor in C, the filters in Python.

Target: the guard takes at most {budget:g} % of the CPU time of a run.
{met} of {runs} runs meet the target.

Each message of the robot and each command passes through Python on the path to the guard. The
physics takes little time, so a run is many times faster than real time, and the share of the guard
is large.
"""
COLUMNS = (
    "Experiment",
    "duration",
    "times real time, without guard",
    "times real time, with guard",
    "guard, per second",
    "guard, relative to the run without it",
)


def page() -> str:
    """The text of the page, with a row for each variant without a hazard."""
    rows = [
        row(experiment, name)
        for experiment in EXPERIMENTS.values()
        for name, variant in experiment.variants.items()
        if not experiment.harms[variant]
    ]
    preface = PREFACE.format(
        processor=processor(),
        rounds=ROUNDS,
        budget=100 * BUDGET,
        met=sum(each.share <= BUDGET for each in rows),
        runs=len(rows),
    )
    head = [f"| {' | '.join(COLUMNS)} |", f"|{'---|' * len(COLUMNS)}"]
    return "\n".join([preface, *head, *map(str, rows), ""])


def main() -> None:
    """Measure and write the page."""
    written_page(__doc__).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
