"""The trainings of the study, by keys such as `steps/ppo/guard/150000/3`, and their parts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import gymnasium

import heron.learning  # noqa: F401  # registers the environments
from heron.learning.arms import guarded
from heron.variants import Formulation, LearningArm

ENVIRONMENTS: Mapping[Formulation, str] = {
    Formulation.STEPS: "heron/PegInHole-v1",
    Formulation.MOVES: "heron/PegInHoleMoves-v1",
    Formulation.TREE: "heron/PegInHole-v1",
}
"""The environment of each formulation."""


@dataclass(frozen=True)
class TrainingRun:
    """One training; `budget` is the number of steps that its environments take together."""

    formulation: Formulation
    algorithm: str
    arm: LearningArm
    budget: int
    seed: int

    @property
    def key(self) -> str:
        """Its name in a campaign."""
        where = f"{self.formulation.value}/{self.algorithm}/{self.arm.value}"
        return f"{where}/{self.budget}/{self.seed}"

    @property
    def folder(self) -> str:
        """The name of the folder of its files."""
        return self.key.replace("/", "-")


def run_of(key: str) -> TrainingRun:
    """The training of a key."""
    formulation, algorithm, arm, budget, seed = key.split("/")
    return TrainingRun(
        Formulation(formulation), algorithm, LearningArm(arm), int(budget), int(seed)
    )


def runs_of(
    formulation: Formulation,
    algorithms: Iterable[str],
    arms: Iterable[LearningArm],
    budget: int,
    seeds: int,
) -> Iterator[TrainingRun]:
    """Seed by seed, so that whatever is done first has all arms."""
    kinds = [(algorithm, arm) for algorithm in algorithms for arm in arms]
    for seed in range(seeds):
        for algorithm, arm in kinds:
            yield TrainingRun(formulation, algorithm, arm, budget, seed)


def environment(formulation: Formulation, arm: LearningArm) -> gymnasium.Env[Any, Any]:
    """A new environment of a formulation, in an arm of the study."""
    return guarded(gymnasium.make(ENVIRONMENTS[formulation], disable_env_checker=True), arm)
