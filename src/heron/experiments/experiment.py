"""An experiment: its variants, its measures and its hazards."""

from __future__ import annotations

import enum
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import Any, Protocol

from ezskiros.engine.events import Event
from heron.appearance import Camera
from heron.experiments.observer import Observer
from heron.experiments.settings import Settings
from heron.experiments.trace import EpisodeTrace
from heron.tasks import TaskStatus, TreeSkill
from heron.variants import ARMS, VARIANTS, ExperimentArm


class Measures(Protocol):
    """The measures of every experiment. Times in s."""

    @property
    def is_completed(self) -> bool:
        """True if the task was done."""

    @property
    def duration(self) -> float:
        """The time from start to end (s), for every outcome."""

    @property
    def interventions(self) -> int:
        """The number of times that an operator came."""

    @property
    def reactions(self) -> Mapping[str, float]:
        """The time from the start of each hazard to the first action against it, by the name of the
        hazard.
        """

    @property
    def time_restricted(self) -> float:
        """For how long rules interfered."""

    @property
    def time_restricted_without_need(self) -> float:
        """For how long of that there was no hazard."""


class EpisodeFacts(Protocol):
    """The facts that are known of every episode."""

    @property
    def arm(self) -> ExperimentArm:
        """The arm of the experiment, which names the guard of the robot."""

    @property
    def seed(self) -> int:
        """The seed of all random numbers."""

    @property
    def outcome(self) -> TaskStatus:
        """The outcome of the task."""

    @property
    def measures(self) -> Measures:
        """The measures that were taken."""

    @property
    def reported(self) -> tuple[tuple[float, str], ...]:
        """The messages of the guard, with their instants (s)."""

    @property
    def onsets(self) -> Mapping[str, float]:
        """The time (s) at which each present hazard began."""

    @property
    def tree(self) -> tuple[TreeSkill, ...]:
        """The skills of the task, and their states."""

    @property
    def events(self) -> Sequence[tuple[float, Event]]:
        """The events of the skills, with their instants (s)."""

    @property
    def trace(self) -> EpisodeTrace:
        """The ground truth of the episode."""


ARM_NAMES: Mapping[ExperimentArm, str] = {
    ExperimentArm.NONE: "no monitor",
    ExperimentArm.COLLISION_MONITOR: "collision monitor",
    ExperimentArm.DEROS: "DeROS",
    ExperimentArm.ROSSMARIE: "ROSSMARie",
    ExperimentArm.SKILL_AWARE: "ROSSMARie with skills",
    ExperimentArm.PROACTIVE: "ROSSMARie with places",
    ExperimentArm.TREES: "ROSSMARie with trees",
    ExperimentArm.LEARNED: "ROSSMARie after learning",
}


@dataclass(frozen=True)
class Measure:
    """A number of an episode: `of` finds it in the measures of the episode; None where there is no
    such thing. A harm is the less, the better.
    """

    name: str
    label: str
    unit: str
    digits: int
    of: Callable[[Any], float | None]

    @property
    def title(self) -> str:
        """`time (s)`."""
        return f"{self.label} ({self.unit})" if self.unit else self.label

    def text(self, value: float) -> str:
        """`23.9 m/s²`."""
        return f"{value:.{self.digits}f} {self.unit}".strip()


@dataclass(frozen=True)
class TraceSignal:
    """A column of the trace for display: multiplied by `factor`, with a line at `limit`. Films show
    its `short` name, if there is one.
    """

    column: str
    label: str
    unit: str
    factor: float = 1.0
    limit: float | None = None
    short: str = ""


@dataclass(frozen=True)
class Experiment:
    """An experiment. `harms` gives for each variant the measures of harm that no earlier variant
    has; without any, all restrictions there are without need. Larger values of `gains` are better.
    `acts_within` is the time (s) within which a rule must act against a hazard, `hazards` are the
    names of the hazards. The demo shows the first variant, by a camera for each scene, from
    `opening` seconds after the beginning of a hazard.
    """

    name: str
    title: str
    about: str
    run: Callable[[ExperimentArm, Any, int, Sequence[Observer], Settings], EpisodeFacts]
    describe: Callable[[Any], str]
    own_measures: tuple[Measure, ...]
    hazards: Mapping[str, str]
    harms: Mapping[enum.Enum, tuple[str, ...]]
    gains: Mapping[enum.Enum, tuple[str, ...]]
    acts_within: Mapping[enum.Enum, Mapping[str, float]]
    signals: tuple[TraceSignal, ...]
    cameras: tuple[Camera, ...]
    opening: tuple[str, float]

    @property
    def variants(self) -> Mapping[str, enum.Enum]:
        """The variants by their names."""
        return {variant.value: variant for variant in VARIANTS[self.name]}

    @property
    def arms(self) -> tuple[ExperimentArm, ...]:
        """The guards that it is run with."""
        return ARMS[self.name]

    @property
    def shown_first(self) -> tuple[ExperimentArm, ...]:
        """The guards of the episodes that are shown side by side: the first one, usually without
        rules, and the last one.
        """
        return self.arms[0], self.arms[-1]

    @property
    def measures(self) -> tuple[Measure, ...]:
        """All of them, in the order in which they are shown."""
        reactions = (_reaction(*each) for each in self.hazards.items())
        return (*_TASK, *self.own_measures, *reactions, *_RESTRICTIONS)

    def opening_of(self, onsets: Iterable[Mapping[str, float]]) -> float:
        """The instant (s) with most to see in episodes whose hazards began at these instants."""
        hazard, later = self.opening
        found = [each[hazard] for each in onsets if hazard in each]
        return max(found) + later if found else 0.0

    def measure(self, name: str) -> Measure:
        """The item with this name. Raises `StopIteration`."""
        return next(one for one in self.measures if one.name == name)


COMPLETED = Measure("completed", "task completed", "", 0, attrgetter("is_completed"))
DURATION = Measure("duration", "time", "s", 1, attrgetter("duration"))
INTERVENTIONS = Measure(
    "interventions", "operator interventions", "", 0, attrgetter("interventions")
)
WITHOUT_NEED = Measure(
    "restricted_without_need",
    "restricted without need",
    "s",
    1,
    attrgetter("time_restricted_without_need"),
)
EXEMPTIONS = Measure("exemptions", "uses of exemptions", "", 0, attrgetter("exemptions"))
_TASK = (COMPLETED, DURATION, INTERVENTIONS)
_RESTRICTIONS = (
    Measure("restricted", "restricted", "s", 1, attrgetter("time_restricted")),
    WITHOUT_NEED,
)


def _reaction(hazard: str, words: str) -> Measure:
    """None without the hazard, or without a reaction."""
    return Measure(
        f"reaction_{hazard}",
        f"reaction, {words}",
        "s",
        2,
        lambda measures: measures.reactions.get(hazard),
    )
