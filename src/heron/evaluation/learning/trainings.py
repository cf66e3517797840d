"""The rows of one algorithm, and queries on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from dslkit.campaign import Scalar, Value
from heron.evaluation.statistics import PairedComparison, compare
from heron.variants import Formulation, LearningArm


@dataclass(frozen=True)
class Trainings:
    """Trainings of one formulation with one algorithm and one budget of steps."""

    formulation: Formulation
    algorithm: str
    budget: int
    rows: Sequence[Value]

    @property
    def arms(self) -> list[LearningArm]:
        """The arms with rows."""
        there = {row["arm"] for row in self.rows}
        return [arm for arm in LearningArm if arm.value in there]

    def of(self, arm: LearningArm) -> list[Value]:
        """The rows of an arm."""
        return [row for row in self.rows if row["arm"] == arm.value]

    def values(self, arm: LearningArm, name: str) -> list[float]:
        """The values of a measure in an arm, without the trainings that have no value."""
        return list(self.by_seed(arm, name).values())

    def by_seed(
        self, arm: LearningArm, name: str, unknown: float | None = None
    ) -> Mapping[int, float]:
        """A measure by seed. A training without a value counts as `unknown`, if that is given."""
        found: dict[int, float] = {}
        for row in self.of(arm):
            value = number(row[name])
            value = unknown if value is None else value
            if value is not None:
                found[int(row["seed"] or 0)] = value
        return found

    def compared(
        self,
        greater: tuple[LearningArm, str],
        lesser: tuple[LearningArm, str],
        unknown: float | None = None,
    ) -> PairedComparison | None:
        """The measures of two arms on the seeds of both; None if no seed is in both."""
        first, second = (self.by_seed(arm, name, unknown) for arm, name in (greater, lesser))
        seeds = sorted(first.keys() & second.keys())
        if not seeds:
            return None
        return compare([first[seed] for seed in seeds], [second[seed] for seed in seeds])


def number(value: Scalar) -> float | None:
    """A cell of a row as a number."""
    return None if value is None else float(value)


def trainings_of(rows: Sequence[Value]) -> list[Trainings]:
    """The rows by formulation, algorithm and budget, in the order of their first rows."""
    kinds = dict.fromkeys((row["formulation"], row["algorithm"], row["budget"]) for row in rows)
    return [
        Trainings(
            Formulation(formulation),
            str(algorithm),
            int(budget or 0),
            [
                row
                for row in rows
                if (row["formulation"], row["algorithm"], row["budget"])
                == (formulation, algorithm, budget)
            ],
        )
        for formulation, algorithm, budget in kinds
    ]
