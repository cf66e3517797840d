"""The one table of all experiments: what they vary, what is measured, what is dangerous in them.

An experiment is one entry here; evaluation, printing, recording and the demo go by it.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import Any, Protocol

from heron.experiments.contact import ContactEpisode, run_contact
from heron.experiments.human import HumanEpisode, run_human
from heron.experiments.navigation import NavigationEpisode, run_navigation
from heron.experiments.observer import Observer
from heron.experiments.placing import PlacingEpisode, run_placing
from heron.experiments.settings import Settings
from heron.experiments.trace import Trace
from heron.scene import BaseParameters
from heron.tasks import Outcome, TreeSkill
from heron.variants import ARMS, VARIANTS, Arm, Encounter, Person, Table, Terrain


class Measures(Protocol):
    """The measures of every experiment. Times in s."""

    @property
    def is_completed(self) -> bool:
        """True if the task was done."""

    @property
    def duration(self) -> float:
        """From the start to the end, whatever it was."""

    @property
    def interventions(self) -> int:
        """The number of times that an operator came."""

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
    """The facts that are known of every episode."""

    @property
    def arm(self) -> Arm:
        """The arm of the experiment, which says what guarded the robot."""

    @property
    def seed(self) -> int:
        """Of all that was left to chance."""

    @property
    def outcome(self) -> Outcome:
        """The outcome of the task."""

    @property
    def shown_first(self) -> tuple[Arm, ...]:
        """The guards of which episodes are shown side by side: none, and the last one."""
        return Arm.NONE, self.arms[-1]

    @property
    def measures(self) -> Measures:
        """The measures that were taken."""

    @property
    def told(self) -> tuple[tuple[float, str], ...]:
        """The messages of the guard, with their instants (s)."""

    @property
    def onsets(self) -> Mapping[str, float]:
        """The instant (s) at which each hazard began, of those that there were."""

    @property
    def tree(self) -> tuple[TreeSkill, ...]:
        """The skills of the task, and what became of them."""

    @property
    def trace(self) -> Trace:
        """The truth about the episode."""


ARM_NAMES: Mapping[Arm, str] = {
    Arm.NONE: "no monitor",
    Arm.COLLISION_MONITOR: "collision monitor",
    Arm.DEROS: "DeROS",
    Arm.ROSSMARIE: "ROSSMARie",
    Arm.SKILL_AWARE: "ROSSMARie with skills",
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

    def text(self, value: float) -> str:
        """`23.9 m/s²`."""
        return f"{value:.{self.digits}f} {self.unit}".strip()


@dataclass(frozen=True)
class Signal:
    """A column of the trace as it is shown: times `factor`, with a line at `limit`. In films it is
    told by its `short` name, if it has one.
    """

    column: str
    label: str
    unit: str
    factor: float = 1.0
    limit: float | None = None
    short: str = ""


@dataclass(frozen=True)
class Camera:
    """The view of an episode (m, degrees), from so far from a place above the body."""

    body: str
    distance: float
    azimuth: float
    elevation: float
    above: float = 0.0


@dataclass(frozen=True)
class Experiment:
    """`harms` names for each variant the measures of what is dangerous there and in no variant
    before it: none, and whatever a monitor restricts there is without need. `gains` are those that
    are the better, the more. `acts_within` says how soon (s) something has to be done about a
    hazard, `hazards` how each is called. The first variant is shown in the demo, by a camera for
    each scene, from so many seconds after the beginning of a hazard on: that is `opening`.
    """

    name: str
    title: str
    about: str
    run: Callable[[Arm, Any, int, Sequence[Observer], Settings], Episode]
    describe: Callable[[Any], str]
    own_measures: tuple[Measure, ...]
    hazards: Mapping[str, str]
    harms: Mapping[enum.Enum, tuple[str, ...]]
    gains: Mapping[enum.Enum, tuple[str, ...]]
    acts_within: Mapping[enum.Enum, Mapping[str, float]]
    signals: tuple[Signal, ...]
    cameras: tuple[Camera, ...]
    opening: tuple[str, float]

    @property
    def variants(self) -> Mapping[str, enum.Enum]:
        """By their names."""
        return {variant.value: variant for variant in VARIANTS[self.name]}

    @property
    def arms(self) -> tuple[Arm, ...]:
        """The guards that it is run with."""
        return ARMS[self.name]

    @property
    def shown_first(self) -> tuple[Arm, ...]:
        """The guards of which episodes are shown side by side: none, and the last one."""
        return Arm.NONE, self.arms[-1]

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
        """The one of that name. Raises `StopIteration`."""
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
    """None where the hazard was not there, or nobody acted on it."""
    return Measure(
        f"reaction_{hazard}",
        f"reaction, {words}",
        "s",
        2,
        lambda measures: measures.reactions.get(hazard),
    )


def _peak(place: str, words: str) -> Measure:
    """None where there is no bump."""
    return Measure(
        f"peak_{place}",
        f"peak acceleration, {words}",
        "m/s²",
        1,
        lambda measures: measures.peaks.get(place),
    )


def _on_terrain(episode: NavigationEpisode) -> str:
    return f"on {episode.terrain.value} terrain"


def _on_table(episode: PlacingEpisode) -> str:
    if episode.table is Table.HURRIED:
        return "to the table in too much haste"
    return f"table {100 * episode.parameters.too_high:.1f} cm too high"


def _of_person(episode: HumanEpisode) -> str:
    return f"somebody {episode.person.value}"


def _of_contact(episode: ContactEpisode) -> str:
    return _ENCOUNTERS[episode.encounter]


_ENCOUNTERS = {
    Encounter.COLLISION: "a forearm in its way",
    Encounter.JAMMED: "the box gets jammed",
    Encounter.MEANT: "all contact is meant",
}
_ON_BUMP = ("peak_front", "peak_drive", "peak_rear")
_OVER_TORQUE = "time_over_torque"
_USUAL_TORQUE = BaseParameters().torque

NAVIGATION = Experiment(
    name="nav",
    title="I, navigation",
    about=(
        "The base drives along a corridor with a bump, up a ramp into a room, and the arm picks up "
        "a block there. The ramp needs more torque than the base usually gives."
    ),
    run=run_navigation,
    describe=_on_terrain,
    own_measures=(
        Measure("replanned", "reroutes", "", 0, attrgetter("replanned")),
        Measure("distance", "distance travelled", "m", 1, attrgetter("distance")),
        *(_peak(axle, f"{axle} axle on the bump") for axle in ("front", "drive", "rear")),
        _peak("elsewhere", "any axle off the bump"),
        Measure(
            _OVER_TORQUE,
            f"torque of {_USUAL_TORQUE:.0f} Nm or more",
            "s",
            1,
            attrgetter("time_over_torque"),
        ),
    ),
    hazards={"bump": "bump", "gentle": "gentle slope", "steep": "steep slope"},
    harms={
        Terrain.GENTLE: (*_ON_BUMP, _OVER_TORQUE),
        Terrain.STEEP: ("peak_elsewhere", _OVER_TORQUE),
        Terrain.FLAT: (),
    },
    gains={},
    acts_within={
        Terrain.GENTLE: {"bump": 0.5, "gentle": 1.0},  # an axle comes 0.7 s after the one before
        Terrain.STEEP: {"steep": 2.5},
    },
    signals=(
        Signal("distance", "distance travelled", "m"),
        Signal("pitch", "tilt", "°", -math.degrees(1), 10.0),
        Signal("torque", "torque of a drive wheel", "Nm", 1.0, _USUAL_TORQUE, "torque"),
    ),
    cameras=(
        Camera("base", distance=3.2, azimuth=62.0, elevation=-14.0, above=0.4),
        Camera("shoulder", distance=2.2, azimuth=130.0, elevation=-14.0),
    ),
    opening=("gentle", 9.5),
)

PLACING = Experiment(
    name="place",
    title="II, placing",
    about=(
        "The arm puts a block on a table that is some centimeters higher than it believes. Its "
        "compliant controller starts to hammer when the block touches the table too early."
    ),
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
    ),
    hazards={"hammering": "hammering", "torque": "torque too high"},
    harms={
        Table.HIGH: ("peak_force", "time_above_30_n"),
        Table.HURRIED: ("peak_effort", "time_over_torque"),
        Table.EXPECTED: (),
    },
    gains={},
    acts_within={Table.HIGH: {"hammering": 0.5}, Table.HURRIED: {"torque": 0.05}},
    signals=(
        Signal("force", "force on the hand", "N", 1.0, 30.0, "force"),
        Signal("height", "height of the hand", "cm", 100.0),
        Signal("effort", "torque, of its limit", "%", 100.0, 60.0),
    ),
    cameras=(Camera("table", distance=0.85, azimuth=140.0, elevation=-5.0, above=0.13),),
    opening=("hammering", 1.9),
)

HUMAN = Experiment(
    name="human",
    title="III, a human in the room",
    about=(
        "The arm carries a block to and fro. Somebody comes in, stands beside it, pushes the hand "
        "aside, and leaves. The red line is as near as a person may come to a moving arm."
    ),
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
        Measure("gives_way", "gives way to a push of 15 N", "m", 2, attrgetter("gives_way")),
        Measure("led", "fastest while it is pushed", "m/s", 2, attrgetter("led")),
    ),
    hazards={"entered": "somebody in the room", "close": "somebody close"},
    harms={
        Person.INSIDE: ("fastest_near", "risk", "time_too_fast"),
        Person.OUTSIDE: (),
    },
    gains={Person.INSIDE: ("gives_way",)},
    acts_within={Person.INSIDE: {"entered": 0.5, "close": 0.3}},
    signals=(
        Signal("distance", "distance of arm and person, up to 2 m", "m", 1.0, 1.0),
        Signal("speed", "speed of the hand", "m/s", 1.0, 0.25, "hand"),
        Signal("x", "hand, to and fro", "m"),
    ),
    cameras=(Camera("shoulder", distance=3.9, azimuth=28.0, elevation=-16.0),),
    opening=("close", 2.0),
)

CONTACT = Experiment(
    name="contact",
    title="IV, contact that is meant",
    about=(
        "The arm pushes a box to a mark, and wipes a board. Both need more force than it may have "
        "elsewhere. In between, somebody reaches over the table."
    ),
    run=run_contact,
    describe=_of_contact,
    own_measures=(
        Measure("pushed", "box pushed", "m", 2, attrgetter("pushed")),
        Measure("wiped", "board wiped", "%", 0, lambda measures: 100 * measures.wiped),
        Measure("peak_force", "peak force on the hand", "N", 0, attrgetter("peak_force")),
        Measure(
            "peak_on_person", "peak force on the forearm", "N", 0, attrgetter("peak_on_person")
        ),
        Measure(
            "time_on_person",
            "forearm pressed with more than 15 N",
            "s",
            2,
            attrgetter("time_on_person"),
        ),
        Measure("peak_in_jam", "peak force in the jam", "N", 0, attrgetter("peak_in_jam")),
        Measure("time_in_jam", "above 30 N in the jam", "s", 2, attrgetter("time_in_jam")),
        EXEMPTIONS,
    ),
    hazards={"collision": "forearm touched", "jam": "box jammed"},
    harms={
        Encounter.COLLISION: ("peak_on_person", "time_on_person"),
        Encounter.JAMMED: ("peak_in_jam", "time_in_jam"),
        Encounter.MEANT: (),
    },
    gains={},
    acts_within={Encounter.COLLISION: {"collision": 0.1}, Encounter.JAMMED: {"jam": 0.3}},
    signals=(
        Signal("force", "force on the hand", "N", 1.0, 15.0, "force"),
        Signal("pressed", "force on the forearm", "N"),
        Signal("pushed", "box pushed", "cm", 100.0),
        Signal("wiped", "board wiped", "%", 100.0),
    ),
    cameras=(Camera("table", distance=1.65, azimuth=211.0, elevation=-19.0, above=0.2),),
    opening=("collision", 0.1),
)

EXPERIMENTS: Mapping[str, Experiment] = {
    one.name: one for one in (NAVIGATION, PLACING, HUMAN, CONTACT)
}
