"""How fast the experiments run, and what the monitor costs in them: writes the table as a page."""

from __future__ import annotations

import time

from machine import processor
from written_page import written_page

from heron.experiments import EXPERIMENTS, USUAL, Experiment
from heron.variants import Arm

ROUNDS = 9


def seconds(experiment: Experiment, variant: str, arm: Arm) -> tuple[float, float]:
    """The CPU time of an episode, and how long it was."""
    start = time.process_time()
    episode = experiment.run(arm, experiment.variants[variant], 0, (), USUAL)
    return time.process_time() - start, episode.measures.duration


def row(experiment: Experiment, variant: str) -> str:
    """The best of some rounds, in turns, so that whatever else the machine does is fair to both."""
    seconds(experiment, variant, Arm.ROSSMARIE)  # compiles the rules
    rounds = [
        (seconds(experiment, variant, Arm.NONE), seconds(experiment, variant, Arm.ROSSMARIE))
        for _ in range(ROUNDS)
    ]
    without, length = min(plain for plain, _ in rounds)
    guarded, guarded_length = min(guarded for _, guarded in rounds)
    assert length == guarded_length, "nothing interferes, so it is the same run"
    cost = (guarded - without) / length
    share = 100 * (guarded - without) / without
    return (
        f"| {experiment.title}, {variant} | {length:.1f} s | {length / without:.1f} "
        f"| {length / guarded:.1f} | {1000 * cost:.0f} ms | {share:.0f} % |"
    )


def page() -> str:
    """The table of all variants in which there is no hazard."""
    lines = [
        "# How fast the experiments run",
        "",
        "Written by `benchmarks/heron_run.py`; do not edit. CPU time of one process, on",
        f"{processor()}. Variants without a hazard: the run is the same with",
        "the monitor and without it. The guard is the one in the process: monitor and reactor in",
        "C, filters in Python.",
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
