"""The trainings of the study, by keys such as `steps/ppo/guard/200000/3`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from heron.variants import Formulation, LearningArm


@dataclass(frozen=True)
class Run:
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


def run_of(key: str) -> Run:
    """The training of a key."""
    formulation, algorithm, arm, budget, seed = key.split("/")
    return Run(Formulation(formulation), algorithm, LearningArm(arm), int(budget), int(seed))


def runs_of(
    formulation: Formulation,
    algorithms: Iterable[str],
    arms: Iterable[LearningArm],
    budget: int,
    seeds: int,
) -> Iterator[Run]:
    """Seed by seed, so that whatever is done first has all arms."""
    kinds = [(algorithm, arm) for algorithm in algorithms for arm in arms]
    for seed in range(seeds):
        for algorithm, arm in kinds:
            yield Run(formulation, algorithm, arm, budget, seed)
