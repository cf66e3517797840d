"""How fast the experiments run, and what the monitor costs in them: writes the table as a page."""

from __future__ import annotations

import time

import numpy as np
from machine import processor
from written_page import written_page

from heron.experiments import EXPERIMENTS, USUAL, Experiment
from heron.guard import Guard
from heron.robot.physics import Floats, Physics
from heron.topics import InProcess
from heron.variants import Arm

ROUNDS = 15


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
        """As an observer of an episode."""
        return [self]

    def tick(self, now_ns: int) -> None:  # noqa: ARG002
        """A tenth of a second later."""
        self.times.append(time.process_time())


def laps(experiment: Experiment, variant: str, arm: Arm) -> tuple[Floats, float]:
    """The CPU time of each tenth of a second of an episode, the start of it and its end included,
    and how long it was.
    """
    noted = Laps()
    episode = experiment.run(arm, experiment.variants[variant], 0, [noted], USUAL)
    noted.times.append(time.process_time())
    return np.diff(noted.times), episode.measures.duration


def row(experiment: Experiment, variant: str) -> str:
    """The least of each tenth of a second in some rounds, in turns, so that whatever else the
    machine does is fair to both.
    """
    laps(experiment, variant, Arm.ROSSMARIE)  # compiles the rules
    rounds = [
        (laps(experiment, variant, Arm.NONE), laps(experiment, variant, Arm.ROSSMARIE))
        for _ in range(ROUNDS)
    ]
    lengths = {length for both in rounds for _, length in both}
    assert len(lengths) == 1, "nothing interferes, so it is the same run"
    length = lengths.pop()
    without = float(np.min([plain for (plain, _), _ in rounds], axis=0).sum())
    guarded = float(np.min([guarded for _, (guarded, _) in rounds], axis=0).sum())
    cost = (guarded - without) / length
    share = 100 * (guarded - without) / without
    return (
        f"| {experiment.title}, {variant} | {length:.1f} s | {length / without:.1f} "
        f"| {length / guarded:.1f} | {1000 * cost:.2f} ms | {share:.1f} % |"
    )


def page() -> str:
    """The table of all variants in which there is no hazard."""
    lines = [
        "# How fast the experiments run",
        "",
        "Written by `benchmarks/heron_run.py`; do not edit. CPU time of one process, on",
        f"{processor()}: of each tenth of a second of a run the least of {ROUNDS}",
        "rounds, with the guard and without it in turns. Variants without a hazard: the run is",
        "the same with the guard and without it. The guard is the one in the process: monitor and",
        "reactor in C, filters in Python.",
        "",
        "| Experiment | length | times real time | with ROSSMARie | the guard, for each second "
        "| of the run without it |",
        "|---|---|---|---|---|---|",
    ]
    for experiment in EXPERIMENTS.values():
        for name, variant in experiment.variants.items():
            if not experiment.harms[variant]:
                lines.append(row(experiment, name))
    return "\n".join(lines) + "\n"


def main() -> None:
    """Measure, and write the page."""
    written_page(__doc__).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
