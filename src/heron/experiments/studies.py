"""Studies: the same episodes with other settings, for default values that we chose and that were
not measured on the robot.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass, replace

from heron.experiments.experiment import Experiment
from heron.experiments.settings import USUAL, Settings
from heron.experiments.table import EXPERIMENTS
from heron.variants import ExperimentArm, Person, Table, Terrain


@dataclass(frozen=True)
class Case:
    """Episodes of a study: a variant of an experiment, with one guard."""

    experiment: str
    variant: enum.Enum
    arm: ExperimentArm

    @property
    def key(self) -> str:
        """`nav/gentle/none`."""
        return f"{self.experiment}/{self.variant.value}/{self.arm.value}"

    @property
    def of(self) -> Experiment:
        """The experiment."""
        return EXPERIMENTS[self.experiment]


@dataclass(frozen=True)
class Study:
    """All cases at all values of one field of `Settings`, each on `seeds` seeds. They are compared
    with episodes of `beside`, which do not depend on this field.
    """

    name: str
    title: str
    setting: str
    label: str
    unit: str
    values: tuple[float, ...]
    cases: tuple[Case, ...]
    beside: ExperimentArm | None = None
    seeds: int = 10

    def settings(self, value: float) -> Settings:
        """The usual settings, with this value."""
        return replace(USUAL, **{self.setting: value})


_STOPPED = (
    ("nav", Terrain.GENTLE),
    ("nav", Terrain.STEEP),
    ("place", Table.HIGH),
    ("place", Table.HURRIED),
    ("human", Person.INSIDE),
)

TORQUE = Study(
    name="torque",
    title="The torque limit",
    setting="usual_torque",
    label="usual torque limit",
    unit="Nm",
    values=(5.0, 5.5, 6.0, 6.5, 7.0, 8.0, 10.0, 13.0),
    cases=tuple(
        Case("nav", Terrain.GENTLE, arm) for arm in (ExperimentArm.NONE, ExperimentArm.ROSSMARIE)
    ),
)
OPERATOR = Study(
    name="operator",
    title="Delay of the operator",
    setting="operator_delay",
    label="delay of the operator",
    unit="s",
    values=(0.0, 10.0, 30.0),
    cases=tuple(Case(name, variant, ExperimentArm.DEROS) for name, variant in _STOPPED),
    beside=ExperimentArm.ROSSMARIE,
)
STUDIES: Mapping[str, Study] = {study.name: study for study in (TORQUE, OPERATOR)}
