"""The table of all experiments: their variants, measures and hazards.

Each experiment is one entry. Evaluation, printing, recording and the demo use this table.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from operator import attrgetter

from heron.appearance import Camera
from heron.experiments.blocked import BlockedEpisode, run_blocked
from heron.experiments.contact import ContactEpisode, run_contact
from heron.experiments.corridor import CorridorEpisode, run_corridor
from heron.experiments.experiment import (
    EXEMPTIONS,
    INTERVENTIONS,
    Experiment,
    Measure,
    TraceSignal,
)
from heron.experiments.human import HumanEpisode, run_human
from heron.experiments.navigation import NavigationEpisode, run_navigation
from heron.experiments.obstacles import OFTEN
from heron.experiments.placing import PlacingEpisode, run_placing
from heron.experiments.second import TEACHING_SEEDS, run_second
from heron.scene import BaseParameters
from heron.variants import Blockage, Encounter, Passage, Person, Table, Terrain, Trouble


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
    return f"a person {episode.person.value}"


def _of_contact(episode: ContactEpisode) -> str:
    return _ENCOUNTERS[episode.encounter]


_ENCOUNTERS = {
    Encounter.COLLISION: "a forearm in the path of the arm",
    Encounter.JAMMED: "the box gets jammed",
    Encounter.MEANT: "all contact is meant",
}
_ON_BUMP = ("peak_front", "peak_drive", "peak_rear")
_TOUCHED = "touched"
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
        Terrain.GENTLE: {"bump": 0.5, "gentle": 1.0},  # an axle comes 0.7 s after the previous axle
        Terrain.STEEP: {"steep": 2.5},
    },
    signals=(
        TraceSignal("distance", "distance travelled", "m"),
        TraceSignal("pitch", "tilt", "°", -math.degrees(1), 10.0),
        TraceSignal("torque", "torque of a drive wheel", "Nm", 1.0, _USUAL_TORQUE, "torque"),
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
        TraceSignal("force", "force on the hand", "N", 1.0, 30.0, "force"),
        TraceSignal("height", "height of the hand", "cm", 100.0),
        TraceSignal("effort", "torque, of its limit", "%", 100.0, 60.0),
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
    hazards={"entered": "a person in the room", "close": "a person close to the arm"},
    harms={
        Person.INSIDE: ("fastest_near", "risk", "time_too_fast"),
        Person.OUTSIDE: (),
    },
    gains={Person.INSIDE: ("gives_way",)},
    acts_within={Person.INSIDE: {"entered": 0.5, "close": 0.3}},
    signals=(
        TraceSignal("distance", "distance of arm and person, up to 2 m", "m", 1.0, 1.0),
        TraceSignal("speed", "speed of the hand", "m/s", 1.0, 0.25, "hand"),
        TraceSignal("x", "hand, to and fro", "m"),
    ),
    cameras=(Camera("shoulder", distance=3.9, azimuth=28.0, elevation=-16.0),),
    opening=("close", 2.0),
)

CONTACT = Experiment(
    name="contact",
    title="IV, contact that is meant",
    about=(
        "The arm pushes a box to a mark, and wipes a board. Both need more force than it may have "
        "elsewhere. In between, a person reaches over the table."
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
        TraceSignal("force", "force on the hand", "N", 1.0, 15.0, "force"),
        TraceSignal("pressed", "force on the forearm", "N"),
        TraceSignal("pushed", "box pushed", "cm", 100.0),
        TraceSignal("wiped", "board wiped", "%", 100.0),
    ),
    cameras=(Camera("table", distance=1.65, azimuth=211.0, elevation=-19.0, above=0.2),),
    opening=("collision", 0.1),
)


def _in_corridor(episode: CorridorEpisode) -> str:
    if episode.dash is None:
        return "no person in the corridor"
    return f"a child {episode.dash.gap:.1f} m before the base"


CORRIDOR = Experiment(
    name="corridor",
    title="V, the corridor of a school",
    about=(
        "The base drives along a corridor, of which a part belongs to a school. A child runs out "
        "of a door, in front of the base: the scanner sees it late."
    ),
    run=run_corridor,
    describe=_in_corridor,
    own_measures=(
        Measure("nearest", "least distance to the child", "m", 2, attrgetter("nearest")),
        Measure(
            "fastest_near",
            "fastest within 0.5 m of the child",
            "m/s",
            2,
            attrgetter("fastest_near"),
        ),
        Measure("impact", "fastest while it touches the child", "m/s", 2, attrgetter("impact")),
    ),
    hazards={"child": "child in the corridor"},
    harms={Passage.CHILD: ("impact", "fastest_near"), Passage.EMPTY: ()},
    gains={},
    acts_within={},
    signals=(
        TraceSignal("x", "along the corridor", "m"),
        TraceSignal("speed", "speed of the base", "m/s", 1.0, 0.5, "speed"),
        TraceSignal("distance", "distance to the child, up to 2 m", "m"),
    ),
    cameras=(Camera("base", distance=4.0, azimuth=20.0, elevation=-28.0, above=0.5),),
    opening=("child", -1.0),
)


def _of_obstacles(episode: BlockedEpisode) -> str:
    return _BLOCKED[episode.variant]


_BLOCKED = {
    Blockage.PALLET: "a pallet on the first path",
    Blockage.TROLLEY: "a trolley on the first path, for a while",
    Blockage.BOTH: "both paths are blocked, the second for a while",
    Trouble.LASTING: "a pallet on the first path, in most runs",
    Trouble.PASSING: "a trolley on the first path for a while, in most runs",
    Trouble.NONE: "nothing on either path",
}
_ON_PATH = Measure(_TOUCHED, "touches an obstacle", "s", 2, attrgetter(_TOUCHED))
_REROUTES = Measure("replanned", "reroutes", "", 0, attrgetter("replanned"))

BLOCKED = Experiment(
    name="blocked",
    title="VI, a blocked path",
    about=(
        "Two paths lead from a junction to a hall, and an obstacle blocks the short path. The base "
        "stops in front of the obstacle by itself. An operator comes if the obstacle stays for too "
        "long."
    ),
    run=run_blocked,
    describe=_of_obstacles,
    own_measures=(
        _REROUTES,
        Measure("nearest", "least distance to an obstacle", "m", 2, attrgetter("nearest")),
        _ON_PATH,
    ),
    hazards={"blocked": "path blocked"},
    harms=dict.fromkeys(Blockage, (INTERVENTIONS.name,)),
    gains={},
    acts_within={},
    signals=(
        TraceSignal("x", "along the first path", "m"),
        TraceSignal("y", "beside the first path", "m"),
        TraceSignal(
            "distance", "distance to an obstacle, up to 2 m", "cm", 100.0, None, "distance"
        ),
    ),
    cameras=(Camera("base", distance=5.5, azimuth=60.0, elevation=-48.0, above=0.4),),
    opening=("blocked", 1.0),
)

ACTIVATIONS = Measure("activations", "activations of rules", "", 0, attrgetter("activations"))
SECOND = replace(
    BLOCKED,
    name="second",
    title="VII, the second run",
    about=(
        "The scene of experiment VI. An obstacle blocks the short path in "
        f"{100 * OFTEN:.0f} % of the runs. The planner finds the path to the hall: without "
        f"knowledge, and with what `ezskiros learn` has counted in {len(TEACHING_SEEDS)} other "
        "runs."
    ),
    run=run_second,
    own_measures=(ACTIVATIONS, _REROUTES, _ON_PATH),
    harms={
        Trouble.LASTING: (ACTIVATIONS.name,),
        Trouble.PASSING: (ACTIVATIONS.name,),
        Trouble.NONE: (),
    },
)

EXPERIMENTS: Mapping[str, Experiment] = {
    one.name: one for one in (NAVIGATION, PLACING, HUMAN, CONTACT, CORRIDOR, BLOCKED, SECOND)
}
