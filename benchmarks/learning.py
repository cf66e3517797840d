"""Measure the simulation and the learning of the insertion; write the tables as a page."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from machine import processor
from written_page import written_page

from heron.learning.arm import Command
from heron.learning.environment import PegInHole
from heron.learning.episodes import Episode
from heron.learning.insertion import READINGS
from heron.learning.runs import Run, environment
from heron.learning.step_training import StepTraining
from heron.learning.summary import steps_to_good
from heron.learning.tree_training import TreeTraining
from heron.variants import BUDGETS, Formulation, LearningArm

ROUNDS, STEPS, SEEDS = 20, 300, 5
PHYSICS_US, LEARNED_S = 150, 300
"""The budgets: the physics of one action, and insertions in nine of ten episodes."""


def least(call: Callable[[Any], object], begin: Callable[[], object]) -> float:
    """The least CPU time of an action in some rounds (µs)."""
    actions = np.random.default_rng(0).uniform(-0.1, 0.1, (STEPS, 4)).astype(np.float32)

    def once() -> float:
        begin()
        start = time.process_time()
        for action in actions:
            call(action)
        return time.process_time() - start

    return 1e6 * min(once() for _ in range(ROUNDS)) / STEPS


def costs() -> Iterator[tuple[str, float]]:
    """Parts of a step, each with those before it."""
    plain: Any = environment(Formulation.STEPS, LearningArm.UNGUARDED).unwrapped
    assert isinstance(plain, PegInHole)
    plain.on_reading.clear()
    arm = plain.insertion.arm

    def follow(action: Any) -> None:
        x, y, z, _ = action.tolist()
        for _ in range(READINGS):
            arm.follow(Command((x, y, z), 0.0))

    yield "the physics", least(follow, lambda: plain.reset(seed=0))
    yield "and the task: readings, person, reward", least(plain.step, lambda: plain.reset(seed=0))
    for arm_of_study, words in (
        (LearningArm.UNGUARDED, "and rules that only count"),
        (LearningArm.GUARD, "and rules that bound what is executed"),
    ):
        env = environment(Formulation.STEPS, arm_of_study)
        yield words, least(env.step, lambda env=env: env.reset(seed=0))  # type: ignore[misc]


def learned(run: Run) -> tuple[int | None, float]:
    """Steps until nine of ten episodes are insertions, and the seconds that they take."""
    began = time.monotonic()
    kind = TreeTraining if run.formulation is Formulation.TREE else StepTraining
    found: list[Episode] = []
    for episode in kind(run).episodes():
        is_whole = bool(found) and episode.steps > found[-1].steps  # of the instant before
        if is_whole and steps_to_good(run.formulation, found) is not None:
            break
        found.append(episode)
    return steps_to_good(run.formulation, found), time.monotonic() - began


def row(formulation: Formulation, algorithm: str, arm: LearningArm) -> str:
    """Trainings with some seeds, one after another."""
    budget = BUDGETS[formulation]
    found = [learned(Run(formulation, algorithm, arm, budget, seed)) for seed in range(SEEDS)]
    good = [steps for steps, _ in found if steps is not None]
    seconds = statistics.median(each for _, each in found)
    steps = f"{statistics.median(good):,.0f}" if good else "-"
    return (
        f"| {formulation.value}, {algorithm}, {arm.value} | {len(good)} of {SEEDS} | {steps} "
        f"| {seconds:.0f} |"
    )


def page() -> str:
    """The tables."""
    kinds = [
        (formulation, algorithm, arm)
        for formulation, algorithm in ((Formulation.STEPS, "ppo"), (Formulation.TREE, "cma-es"))
        for arm in (LearningArm.UNGUARDED, LearningArm.GUARD)
    ]
    lines = [
        "# How fast the insertion is learned",
        "",
        f"Written by `benchmarks/learning.py`; do not edit. On {processor()}.",
        "",
        f"CPU time of one action of 40 ms, the least of {ROUNDS} rounds. The physics may take "
        f"{PHYSICS_US} µs.",
        "",
        "| One action | µs |",
        "|---|---|",
        *(f"| {words} | {cost:.0f} |" for words, cost in costs()),
        "",
        f"Time until nine of ten episodes are insertions, with a clearance of 3 mm: the median of "
        f"{SEEDS} seeds, one",
        f"training at a time, with what JAX compiles. It may take {LEARNED_S} s.",
        "",
        "| Training | learned | steps | seconds |",
        "|---|---|---|---|",
        *(row(*kind) for kind in kinds),
    ]
    return "\n".join(lines) + "\n"


def main() -> None:
    """Measure, and write the page."""
    written_page(__doc__).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
