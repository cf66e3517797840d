"""Measure the simulation and the training of the insertion; write the tables as a page."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from machine import processor
from written_page import written_page

from heron.learning.arm import ArmCommand
from heron.learning.environment import PegInHole
from heron.learning.episodes import TrainingEpisode
from heron.learning.insertion import READINGS
from heron.learning.runs import TrainingRun, environment
from heron.learning.step_training import StepTraining
from heron.learning.summary import steps_to_good
from heron.learning.tree_training import TreeTraining
from heron.variants import BUDGETS, Formulation, LearningArm

ROUNDS, STEPS, SEEDS = 20, 300, 5
PHYSICS_US, LEARNED_S = 150, 300
"""The targets: the physics of one action, and the time until nine of ten episodes succeed."""


def least(call: Callable[[Any], object], begin: Callable[[], object]) -> float:
    """The minimum CPU time of an action over the rounds (µs)."""
    actions = np.random.default_rng(0).uniform(-0.1, 0.1, (STEPS, 4)).astype(np.float32)

    def once() -> float:
        begin()
        start = time.process_time()
        for action in actions:
            call(action)
        return time.process_time() - start

    return 1e6 * min(once() for _ in range(ROUNDS)) / STEPS


def costs() -> Iterator[tuple[str, float]]:
    """The cost of a step (µs), with more and more of its parts."""
    plain: Any = environment(Formulation.STEPS, LearningArm.UNGUARDED).unwrapped
    assert isinstance(plain, PegInHole)
    plain.on_reading.clear()
    arm = plain.insertion.arm

    def follow(action: Any) -> None:
        x, y, z, _ = action.tolist()
        for _ in range(READINGS):
            arm.follow(ArmCommand((x, y, z), 0.0))

    yield "physics", least(follow, lambda: plain.reset(seed=0))
    yield (
        "physics and task (readings, person, reward)",
        least(plain.step, lambda: plain.reset(seed=0)),
    )
    for arm_of_study, words in (
        (LearningArm.UNGUARDED, "physics, task, and rules that only count"),
        (LearningArm.GUARD, "physics, task, and rules that bound the executed action"),
    ):
        env = environment(Formulation.STEPS, arm_of_study)
        yield words, least(env.step, lambda env=env: env.reset(seed=0))  # type: ignore[misc]


def learned(run: TrainingRun) -> tuple[int | None, float]:
    """The steps until nine of ten episodes end with an insertion, and their time (s)."""
    began = time.monotonic()
    kind = TreeTraining if run.formulation is Formulation.TREE else StepTraining
    found: list[TrainingEpisode] = []
    for episode in kind(run).episodes():
        is_whole = (
            bool(found) and episode.steps > found[-1].steps
        )  # the episodes of the instant before are complete
        if is_whole and steps_to_good(run.formulation, found) is not None:
            break
        found.append(episode)
    return steps_to_good(run.formulation, found), time.monotonic() - began


def row(formulation: Formulation, algorithm: str, arm: LearningArm) -> str:
    """The row of one kind of training; the trainings of the seeds run one after another."""
    budget = BUDGETS[formulation]
    found = [
        learned(TrainingRun(formulation, algorithm, arm, budget, seed)) for seed in range(SEEDS)
    ]
    good = [steps for steps, _ in found if steps is not None]
    seconds = statistics.median(each for _, each in found)
    steps = f"{statistics.median(good):,.0f}" if good else "-"
    return (
        f"| {formulation.value}, {algorithm}, {arm.value} | {len(good)} of {SEEDS} | {steps} "
        f"| {seconds:.0f} |"
    )


ACTIONS = """\
# Speed of the training of the insertion

Written by `benchmarks/learning.py`; do not edit. All figures were measured on {processor}.

The first table shows the CPU time of one action of 40 ms, the minimum of {rounds} rounds. The
target for the physics is {physics} µs.

| One action | µs |
|---|---|"""
TRAININGS = """
The second table shows the time until nine of ten episodes end with an insertion, with a clearance
of 3 mm. The trainings run one after another, and the time includes the compilation by JAX. The
steps are the median of the seeds that learned the insertion; the seconds are the median of all
{seeds} seeds. The target is {seconds} s.

| Training | seeds that learned the insertion | steps | seconds |
|---|---|---|---|"""


def page() -> str:
    """The text of the page."""
    kinds = [
        (formulation, algorithm, arm)
        for formulation, algorithm in ((Formulation.STEPS, "ppo"), (Formulation.TREE, "cma-es"))
        for arm in (LearningArm.UNGUARDED, LearningArm.GUARD)
    ]
    lines = [
        ACTIONS.format(processor=processor(), rounds=ROUNDS, physics=PHYSICS_US),
        *(f"| {about} | {cost:.0f} |" for about, cost in costs()),
        TRAININGS.format(seeds=SEEDS, seconds=LEARNED_S),
        *(row(*kind) for kind in kinds),
    ]
    return "\n".join(lines) + "\n"


def main() -> None:
    """Measure and write the page."""
    written_page(__doc__).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
