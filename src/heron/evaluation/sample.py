"""The rows of one variant of an experiment, and queries on them."""

from __future__ import annotations

import enum
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from heron.evaluation.rows import EpisodeRow
from heron.evaluation.statistics import PairedComparison, compare
from heron.experiments import Experiment
from heron.experiments.experiment import COMPLETED
from heron.variants import ExperimentArm


@dataclass(frozen=True)
class Sample:
    """The episodes of one variant; `rows` are the rows of `variant`."""

    experiment: Experiment
    variant: str
    rows: Sequence[EpisodeRow]

    @property
    def harms(self) -> tuple[str, ...]:
        """The measures of harm in it."""
        return self.experiment.harms[self._of_variant]

    @property
    def gains(self) -> tuple[str, ...]:
        """The measures that are the better, the more."""
        return self.experiment.gains.get(self._of_variant, ())

    @property
    def acts_within(self) -> Mapping[str, float]:
        """The longest permitted reaction time of the guard for each hazard (s)."""
        return self.experiment.acts_within.get(self._of_variant, {})

    @property
    def arms(self) -> tuple[ExperimentArm, ...]:
        """The guards of the robot."""
        return self.experiment.arms

    @property
    def _of_variant(self) -> enum.Enum:
        return self.experiment.variants[self.variant]

    def values(self, arm: ExperimentArm, name: str) -> list[float]:
        """A measure of all episodes of an arm that have it."""
        return [row.numbers[name] for row in self._of(arm) if name in row.numbers]

    def count(self, arm: ExperimentArm) -> int:
        """The number of episodes."""
        return len(self._of(arm))

    def completed(self, arm: ExperimentArm) -> int:
        """In how many of them the task was done."""
        return sum(value > 0 for value in self.values(arm, COMPLETED.name))

    def compared(
        self, name: str, greater: ExperimentArm, lesser: ExperimentArm
    ) -> PairedComparison:
        """A measure in two arms, on the seeds that both have."""
        first, second = self.by_seed(greater, name), self.by_seed(lesser, name)
        seeds = sorted(first.keys() & second.keys())
        return compare([first[seed] for seed in seeds], [second[seed] for seed in seeds])

    def by_seed(self, arm: ExperimentArm, name: str) -> dict[int, float]:
        """A measure of all episodes of an arm that have it, by their seeds."""
        return {row.seed: row.numbers[name] for row in self._of(arm) if name in row.numbers}

    def _of(self, arm: ExperimentArm) -> list[EpisodeRow]:
        return [row for row in self.rows if row.arm == arm.value]


def samples_of(experiment: Experiment, rows: Sequence[EpisodeRow]) -> list[Sample]:
    """One for each variant that there are rows of."""
    found = [
        Sample(experiment, variant, [row for row in rows if row.variant == variant])
        for variant in experiment.variants
    ]
    return [sample for sample in found if all(map(sample.count, experiment.arms))]
