"""Measure the speed of the experiments, and the cost of the monitor in them; write the table as a
page.
"""

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
from heron.variants import Arm

ROUNDS = 15
BUDGET = 0.01
"""The part of a run that the guard may take."""


class Laps:
    """Looks on, and notes the CPU time of this process after each tenth of a second."""

    period_ns = 100_000_000

    def __init__(self) -> None:
        self.times = [time.process_time()]

    def attend(
        self,
        physics: Physics,  # noqa: ARG002
        carrier: InProcess,  # noqa: ARG002
        guard: Guard | None,  # noqa: ARG002
    ) -> list[Laps]:
        """Observe an episode: return the observers."""
        return [self]

    def tick(self, now_ns: int) -> None:  # noqa: ARG002
        """A tenth of a second later."""
        self.times.append(time.process_time())


@dataclass(frozen=True)
class Row:
    """A run of some length, and the CPU time that it takes without the guard and with it (s)."""

    title: str
    length: float
    without: float
    guarded: float

    @property
    def share(self) -> float:
        """The guard's part of a run without it."""
        return (self.guarded - self.without) / self.without

    def __str__(self) -> str:
        cost = (self.guarded - self.without) / self.length
        return (
            f"| {self.title} | {self.length:.1f} s | {self.length / self.without:.1f} "
            f"| {self.length / self.guarded:.1f} | {1000 * cost:.2f} ms "
            f"| {100 * self.share:.1f} % |"
        )


def laps(experiment: Experiment, variant: str, arm: Arm) -> tuple[Floats, float]:
    """The CPU time of each tenth of a second of an episode, the start of it and its end included,
    and how long it was.
    """
    noted = Laps()
    episode = experiment.run(arm, experiment.variants[variant], 0, [noted], USUAL)
    noted.times.append(time.process_time())
    return np.diff(noted.times), episode.measures.duration


def row(experiment: Experiment, variant: str) -> Row:
    """The least of each tenth of a second in some rounds, in turns, so that whatever else the
    machine does is fair to both.
    """
    guarded_arm = experiment.arms[-1]  # whose rules know most
    laps(experiment, variant, guarded_arm)  # compiles the rules
    rounds = [
        (laps(experiment, variant, Arm.NONE), laps(experiment, variant, guarded_arm))
        for _ in range(ROUNDS)
    ]
    lengths = {length for both in rounds for _, length in both}
    assert len(lengths) == 1, "nothing interferes, so it is the same run"
    length = lengths.pop()
    without = float(np.min([plain for (plain, _), _ in rounds], axis=0).sum())
    guarded = float(np.min([guarded for _, (guarded, _) in rounds], axis=0).sum())
    return Row(f"{experiment.title}, {variant}", length, without, guarded)


def page() -> str:
    """The table of all variants in which there is no hazard."""
    rows = [
        row(experiment, name)
        for experiment in EXPERIMENTS.values()
        for name, variant in experiment.variants.items()
        if not experiment.harms[variant]
    ]
    kept = sum(each.share <= BUDGET for each in rows)
    lines = [
        "# How fast the experiments run",
        "",
        "Written by `benchmarks/heron_run.py`; do not edit. CPU time of one process, on",
        f"{processor()}: of each tenth of a second of a run the least of {ROUNDS}",
        "rounds, with the guard and without it in turns. Variants without a hazard: the run is",
        "the same with the guard and without it. The guard is the one in the process: monitor and",
        "reactor in C, filters in Python.",
        "",
        f"The guard may take {100 * BUDGET:g} % of a run: {kept} of {len(rows)} runs keep to that. "
        "Each message of the robot, and each",
        "command, goes through Python on its way to the guard, and the physics behind it takes",
        "little more: a run is many times as fast as real time.",
        "",
        "| Experiment | length | times real time | with ROSSMARie | the guard, for each second "
        "| of the run without it |",
        "|---|---|---|---|---|---|",
        *map(str, rows),
    ]
    return "\n".join(lines) + "\n"


def main() -> None:
    """Measure, and write the page."""
    written_page(__doc__).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
