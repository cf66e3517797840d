"""Experiment IV: the arm pushes a box to a mark and wipes a board, near a person. Both tasks need
more force than is allowed elsewhere.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ezskiros.engine.events import Event
from heron.experiments.arm_cell import ArmCell
from heron.experiments.arms import CONTACT_RULES, machine_of
from heron.experiments.bystander import Bystander, varied
from heron.experiments.contact_witness import ContactWitness
from heron.experiments.episode import acting, reported_by, seeded
from heron.experiments.measures import Flags, onsets, time_of, without_need
from heron.experiments.observer import Observer, attended
from heron.experiments.runner import SimulatedNode
from heron.experiments.settings import USUAL, Settings
from heron.experiments.trace import EpisodeTrace
from heron.experiments.wiping import Stains
from heron.goals import ARM
from heron.guard import InProcessGuard, Occurrence, unfiltered
from heron.robot import (
    Arm as RobotArm,
)
from heron.robot import (
    ArmController,
    ArmControllerParameters,
    ForceTorque,
    ForceTorqueParameters,
)
from heron.robot.physics import Floats
from heron.robot.pressing import Pressing, PushMotion, PushParameters, WipeMotion, WipeParameters
from heron.scene import ArmParameters, CellParameters, PersonParameters, build_cell
from heron.tasks import SkillContextPublisher, SkillTask, TaskStatus, TreeSkill
from heron.topics import Carrier, InProcess, Remapped
from heron.variants import Encounter, ExperimentArm
from rossmarie.ir import Change, TaskCommandKind

LONGEST_S = 120.0
SPONGE = ArmParameters(block_half=0.032)
"""The arm, whose block is a sponge: wider than the hand, which must not touch the board."""
CAREFUL = ArmControllerParameters(carrying_speed=0.25, carrying_acceleration=1.0)
"""Nowhere faster than the reduced speed of ISO 10218-1: people are about."""
_BESIDE = 0.025  # m from the box, before it is pushed
_BEFORE = 0.015  # m from the board, before it is pressed on
_ABOVE_TABLE = 0.015
_OVER = 0.95  # m: the height of paths over the table
_INTO_BOARD = np.array([0.0, -1.0, 0.0])
_NEAR_MARK = 0.01  # m
_TOUCHED = 1.0  # N on the forearm
_LIGHT, _PERMITTED = 15.0, 30.0  # N, as in the rules
_EXEMPT = "_doing_"
_SETTLING_STEPS = 250
_SEEDED = ("cell", "bystander", "force")


@dataclass(frozen=True)
class ContactMeasures:
    """Times in s, forces in N, lengths in m. `peak_force` is the largest force on the hand, and
    `peak_on_person` is the largest force on the forearm. `peak_in_jam` is the largest force on the
    hand while the box is jammed at the fixed obstacle. `time_on_person` is the time above 15 N, and
    `time_in_jam` is the time above 30 N. They are None without such contact. `wiped` is the share
    of the removed stains, and `exemptions` is the number of exemptions that rules granted because
    of a skill.
    """

    is_completed: bool
    duration: float
    interventions: int
    pushed: float
    wiped: float
    peak_force: float
    peak_on_person: float | None
    time_on_person: float | None
    peak_in_jam: float | None
    time_in_jam: float | None
    exemptions: int
    reactions: Mapping[str, float]
    time_restricted: float
    time_restricted_without_need: float


@dataclass(frozen=True)
class ContactEpisode:
    """One run: its settings, its result, and the log of the guard."""

    arm: ExperimentArm
    encounter: Encounter
    seed: int
    cell: CellParameters
    outcome: TaskStatus
    measures: ContactMeasures
    reported: tuple[tuple[float, str], ...]
    onsets: Mapping[str, float]
    tree: tuple[TreeSkill, ...]
    events: Sequence[tuple[float, Event]]
    trace: EpisodeTrace


@dataclass
class _Cell(ArmCell):
    """The arm, and the measuring of its contacts."""

    rules: InProcessGuard | None
    witness: ContactWitness


def run_contact(
    arm: ExperimentArm,
    encounter: Encounter,
    seed: int,
    observers: Sequence[Observer] = (),
    settings: Settings = USUAL,  # noqa: ARG001
) -> ContactEpisode:
    """One episode. The same arguments give the same episode, number for number."""
    generators = seeded(_SEEDED, seed)
    found = varied_cell(encounter, generators["cell"])
    cell = _assembled(arm, encounter, found, generators, observers)
    cell.play(LONGEST_S)
    trace = cell.witness.trace()
    return ContactEpisode(
        arm=arm,
        encounter=encounter,
        seed=seed,
        cell=found,
        outcome=cell.task.outcome,
        measures=_measured(cell, found, trace),
        reported=reported_by(cell.guard),
        onsets=onsets(trace, hazards(trace)),
        tree=cell.task.tree,
        events=cell.task.events,
        trace=trace,
    )


def varied_cell(encounter: Encounter, generator: np.random.Generator) -> CellParameters:
    """The parameters of the cell that differ from seed to seed."""
    usual = CellParameters()
    x, y = usual.box_place
    found = replace(
        usual,
        friction=float(generator.uniform(0.42, 0.5)),
        box_place=(
            x + float(generator.uniform(-0.02, 0.02)),
            y + float(generator.uniform(0, 0.01)),
        ),
        push_distance=float(generator.uniform(0.14, 0.17)),
        board_friction=float(generator.uniform(0.35, 0.42)),
    )
    jam = float(generator.uniform(0.04, 0.1))
    return replace(found, jam=jam) if encounter is Encounter.JAMMED else found


def _assembled(
    arm: ExperimentArm,
    encounter: Encounter,
    cell: CellParameters,
    generators: Mapping[str, np.random.Generator],
    observers: Sequence[Observer],
) -> _Cell:
    person = PersonParameters()
    robot = RobotArm(build_cell(cell, SPONGE, person), SPONGE)
    reaching = varied(encounter, generators["bystander"])
    bystander = Bystander(robot, cell, person, reaching)
    stains = Stains(robot, cell, SPONGE)
    robot.settle(_SETTLING_STEPS)
    carrier = InProcess()
    places = places_of(cell) | {"home": robot.grasp.copy()}
    controller = ArmController(robot, carrier, places, CAREFUL, pressings_of(cell))
    force = ForceTorque(robot, carrier, generators["force"], ForceTorqueParameters())
    nodes: list[SimulatedNode] = [bystander, stains, force, controller]
    guard = None
    view: Carrier = carrier
    if arm in CONTACT_RULES:
        guard = InProcessGuard(machine_of(CONTACT_RULES[arm]), carrier, lambda: robot.now_ns)
        nodes.append(guard)
        view = Remapped(carrier, {ARM: unfiltered(ARM)})
    task = SkillTask(view, "TidyUp", "contact.turtle", ["Box=box", "Mark=mark", "Board=board"])
    witness = ContactWitness(robot, cell, bystander, stains, acting(guard))
    nodes += [task, SkillContextPublisher(carrier, task), witness]
    nodes += attended(observers, robot, carrier, guard)
    return _Cell(robot, task, guard, None, nodes, guard, witness)


def places_of(cell: CellParameters) -> dict[str, Floats]:
    """The places that the sponge is carried to."""
    (x, y), half = cell.box_place, SPONGE.block_half
    before_box = np.array(
        [x, y + cell.box_half[1] + half + _BESIDE, cell.table_height + half + _ABOVE_TABLE]
    )
    above_box = before_box.copy()
    above_box[2] = _OVER
    before_board = _strokes(cell)[0] - _BEFORE * _INTO_BOARD
    return {"above_box": above_box, "before_box": before_box, "before_board": before_board}


def pressings_of(cell: CellParameters) -> dict[str, Pressing]:
    """The motions whose contact is meant."""
    x, y = cell.mark
    end = places_of(cell)["before_box"]
    end[:2] = x, y + cell.box_half[1] + SPONGE.block_half
    return {
        "push": PushMotion(end, PushParameters()),
        "wipe": WipeMotion(_strokes(cell), _INTO_BOARD, WipeParameters()),
    }


def _strokes(cell: CellParameters) -> list[Floats]:
    """To and fro, a row at a time."""
    y = cell.board_face + SPONGE.block_half
    found = []
    for row, z in enumerate(cell.rows):
        stroke = cell.stroke if row % 2 == 0 else cell.stroke[::-1]
        found += [np.array([x, y, z]) for x in stroke]
    return found


def hazards(trace: EpisodeTrace) -> dict[str, Flags]:
    """The rows with each hazard: the arm touches the person, or the box is jammed."""
    return {
        "collision": trace.columns["pressed"] > _TOUCHED,
        "jam": trace.columns["is_jammed"] > 0,
    }


def _measured(cell: _Cell, found: CellParameters, trace: EpisodeTrace) -> ContactMeasures:
    present = hazards(trace)
    force, pressed = trace.columns["force"], trace.columns["pressed"]
    wiped = float(trace.columns["wiped"][-1])
    is_pushed = math.dist(cell.witness.box, found.mark) < _NEAR_MARK
    return ContactMeasures(
        is_completed=cell.task.outcome is TaskStatus.COMPLETED and is_pushed and wiped == 1.0,
        duration=cell.arm.now_ns * 1e-9,
        interventions=cell.visits,
        pushed=float(trace.columns["pushed"][-1]),
        wiped=wiped,
        peak_force=float(force.max()),
        peak_on_person=_peak(pressed, present["collision"]),
        time_on_person=_time_above(_LIGHT, pressed, present["collision"]),
        peak_in_jam=_peak(force, present["jam"]),
        time_in_jam=_time_above(_PERMITTED, force, present["jam"]),
        exemptions=_exemptions(cell.rules),
        reactions=_reactions(trace, present, cell.occurrences),
        time_restricted=time_of(trace.columns["is_restricted"] > 0),
        time_restricted_without_need=time_of(without_need(trace, present)),
    )


def _peak(values: Floats, flags: Flags) -> float | None:
    return float(values[flags].max()) if flags.any() else None


def _time_above(limit: float, values: Floats, flags: Flags) -> float | None:
    return time_of(flags & (values > limit)) if flags.any() else None


def _exemptions(guard: InProcessGuard | None) -> int:
    """The number of uses of exemptions: their replacement rules are active meanwhile."""
    if guard is None:
        return 0
    telling = {number for number, rule in enumerate(guard.machine.rules)
               if rule.exempts is not None and _EXEMPT in rule.name}  # fmt: skip
    return sum(each.rule in telling and each.change is Change.ACTIVATED for each in guard.verdicts)


def _reactions(
    trace: EpisodeTrace, present: Mapping[str, Flags], occurrences: Sequence[Occurrence]
) -> dict[str, float]:
    """Return the times from the start of each hazard to the first action after it. All rules
    concern contact.
    """
    starts = [each.at_ns * 1e-9 for each in occurrences if each.kind is TaskCommandKind.START]
    found = {}
    for hazard, onset in onsets(trace, present).items():
        after = [at for at in starts if at >= onset]
        if after:
            found[hazard] = after[0] - onset
    return found
