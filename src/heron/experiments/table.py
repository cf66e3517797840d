"""The one table of all experiments: what they vary, what is measured, what is dangerous in them.

An experiment is one entry here; evaluation, printing, recording and the demo go by it.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import Any, Protocol

from heron.experiments.human import HumanEpisode, run_human
from heron.experiments.navigation import NavigationEpisode, run_navigation
from heron.experiments.observer import Observer
from heron.experiments.placing import PlacingEpisode, run_placing
from heron.experiments.trace import Trace
from heron.tasks import Outcome, TreeSkill
from heron.variants import VARIANTS, Arm, Person, Table, Terrain


class Measures(Protocol):
    """What is measured in every experiment. Times in s."""

    @property
    def is_completed(self) -> bool:
        """Whether the task was done."""

    @property
    def duration(self) -> float:
        """From the start to the end, whatever it was."""

    @property
    def interventions(self) -> int:
        """How often an operator came."""

    @property
    def reactions(self) -> Mapping[str, float]:
        """From when a hazard began to the first action against it, by the name of the hazard."""

    @property
    def time_restricted(self) -> float:
        """For how long rules interfered."""

    @property
    def time_restricted_without_need(self) -> float:
        """For how long of that there was no hazard."""


class Episode(Protocol):
    """What is known of every episode."""

    @property
    def arm(self) -> Arm:
        """What guarded the robot."""

    @property
    def seed(self) -> int:
        """Of all that was left to chance."""

    @property
    def outcome(self) -> Outcome:
        """How it ended."""

    @property
    def measures(self) -> Measures:
        """What was measured."""

    @property
    def told(self) -> tuple[tuple[float, str], ...]:
        """What the guard said, with its instants (s)."""

    @property
    def tree(self) -> tuple[TreeSkill, ...]:
        """What became of the skills of the task."""

    @property
    def trace(self) -> Trace:
        """What really happened."""


ARM_NAMES = {Arm.NONE: "no monitor", Arm.DEROS: "DeROS", Arm.ROSSMARIE: "ROSSMARie"}


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

    def text(self, value: float) -> str:
        """`23.9 m/s²`."""
        return f"{value:.{self.digits}f} {self.unit}".strip()


@dataclass(frozen=True)
class Signal:
    """A column of the trace as it is shown: times `factor`, with a line at `limit`."""

    column: str
    label: str
    unit: str
    factor: float = 1.0
    limit: float | None = None


@dataclass(frozen=True)
class Camera:
    """From where an episode is looked at (m, degrees): so far from the body, in that direction."""

    body: str
    distance: float
    azimuth: float
    elevation: float


@dataclass(frozen=True)
class Experiment:
    """`harms` names for each variant the measures of what is dangerous there: none, and whatever a
    monitor restricts there is without need. The first variant is shown in the demo, by a camera for
    each scene.
    """

    name: str
    title: str
    run: Callable[[Arm, Any, int, Sequence[Observer]], Episode]
    describe: Callable[[Any], str]
    own_measures: tuple[Measure, ...]
    harms: Mapping[enum.Enum, tuple[str, ...]]
    signals: tuple[Signal, ...]
    cameras: tuple[Camera, ...]

    @property
    def variants(self) -> Mapping[str, enum.Enum]:
        """By their names."""
        return {variant.value: variant for variant in VARIANTS[self.name]}

    @property
    def measures(self) -> tuple[Measure, ...]:
        """All of them, in the order in which they are shown."""
        return (*_TASK, *self.own_measures, *_RESTRICTIONS)

    def measure(self, name: str) -> Measure:
        """The one of that name. Raises `StopIteration`."""
        return next(one for one in self.measures if one.name == name)


COMPLETED = Measure("completed", "task completed", "", 0, attrgetter("is_completed"))
DURATION = Measure("duration", "time", "s", 1, attrgetter("duration"))
INTERVENTIONS = Measure(
    "interventions", "visits of the operator", "", 0, attrgetter("interventions")
)
WITHOUT_NEED = Measure(
    "restricted_without_need",
    "restricted without need",
    "s",
    1,
    attrgetter("time_restricted_without_need"),
)
_TASK = (COMPLETED, DURATION, INTERVENTIONS)
_RESTRICTIONS = (
    Measure("restricted", "restricted", "s", 1, attrgetter("time_restricted")),
    WITHOUT_NEED,
)


def _reaction(hazard: str, words: str) -> Measure:
    """None where the hazard was not there, or nobody acted on it."""
    return Measure(
        f"reaction_{hazard}",
        f"reaction, {words}",
        "s",
        2,
        lambda measures: measures.reactions.get(hazard),
    )


def _peak(axle: str) -> Measure:
    return Measure(
        f"peak_{axle}",
        f"peak acceleration, {axle} axle",
        "m/s²",
        1,
        lambda measures: measures.peaks[axle],
    )


def _on_terrain(episode: NavigationEpisode) -> str:
    return f"on {episode.terrain.value} terrain"


def _on_table(episode: PlacingEpisode) -> str:
    if episode.table is Table.HURRIED:
        return "to the table in too much haste"
    return f"table {100 * episode.parameters.too_high:.1f} cm too high"


def _of_person(episode: HumanEpisode) -> str:
    return f"somebody {episode.person.value}"


_PEAKS = ("peak_front", "peak_drive", "peak_rear")
_STALLS = "time_at_torque_limit"

NAVIGATION = Experiment(
    name="nav",
    title="I, navigation",
    run=run_navigation,
    describe=_on_terrain,
    own_measures=(
        Measure("replanned", "other ways taken", "", 0, attrgetter("replanned")),
        *map(_peak, ("front", "drive", "rear")),
        Measure(_STALLS, "at the limit of torque", "s", 1, attrgetter("time_at_torque_limit")),
        _reaction("bump", "bump"),
        _reaction("gentle", "gentle slope"),
        _reaction("steep", "steep slope"),
    ),
    harms={
        Terrain.GENTLE: (*_PEAKS, _STALLS),
        Terrain.STEEP: (*_PEAKS, _STALLS),
        Terrain.FLAT: (),
    },
    signals=(
        Signal("x", "way", "m"),
        Signal("pitch", "tilt", "°", -math.degrees(1), 10.0),
        Signal("effort", "torque, of its limit", "%", 100.0, 100.0),
    ),
    cameras=(
        Camera("base", distance=3.6, azimuth=75.0, elevation=-16.0),
        Camera("shoulder", distance=1.9, azimuth=130.0, elevation=-12.0),
    ),
)

PLACING = Experiment(
    name="place",
    title="II, placing",
    run=run_placing,
    describe=_on_table,
    own_measures=(
        Measure("attempts", "attempts", "", 0, attrgetter("attempts")),
        Measure("peak_force", "peak force", "N", 0, attrgetter("peak_force")),
        Measure("time_above_30_n", "above 30 N", "s", 2, attrgetter("time_above_30_n")),
        Measure(
            "peak_effort",
            "peak torque of a joint, of its limit",
            "%",
            0,
            lambda measures: 100 * measures.peak_effort,
        ),
        Measure(
            "time_over_torque",
            "torque above 60 % of the limit",
            "s",
            2,
            attrgetter("time_over_torque"),
        ),
        _reaction("hammering", "hammering"),
        _reaction("torque", "torque too high"),
    ),
    harms={
        Table.HIGH: ("peak_force", "time_above_30_n"),
        Table.HURRIED: ("peak_effort", "time_over_torque"),
        Table.EXPECTED: (),
    },
    signals=(
        Signal("force", "force on the hand", "N", 1.0, 30.0),
        Signal("height", "height of the hand", "cm", 100.0),
        Signal("effort", "torque, of its limit", "%", 100.0, 60.0),
    ),
    cameras=(Camera("table", distance=1.3, azimuth=130.0, elevation=-10.0),),
)

HUMAN = Experiment(
    name="human",
    title="III, a human in the room",
    run=run_human,
    describe=_of_person,
    own_measures=(
        Measure("nearest", "least distance to the person", "m", 2, attrgetter("nearest")),
        Measure(
            "fastest_near", "fastest within 1 m of the person", "m/s", 2, attrgetter("fastest_near")
        ),
        Measure("risk", "greatest product of speed and closeness", "m/s", 2, attrgetter("risk")),
        Measure(
            "time_too_fast", "faster than 0.25 m/s within 1 m", "s", 1, attrgetter("time_too_fast")
        ),
        _reaction("entered", "somebody in the room"),
        _reaction("close", "somebody close"),
    ),
    harms={
        Person.INSIDE: ("fastest_near", "risk", "time_too_fast"),
        Person.OUTSIDE: (),
    },
    signals=(
        Signal("distance", "distance of arm and person, up to 2 m", "m", 1.0, 1.0),
        Signal("speed", "speed of the hand", "m/s", 1.0, 0.25),
        Signal("x", "hand, to and fro", "m"),
    ),
    cameras=(Camera("shoulder", distance=3.2, azimuth=25.0, elevation=-16.0),),
)

EXPERIMENTS: Mapping[str, Experiment] = {one.name: one for one in (NAVIGATION, PLACING, HUMAN)}
