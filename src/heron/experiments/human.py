"""Experiment III: the arm carries its block to and fro while a person enters the room."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ezskiros.engine.events import Event
from heron.experiments.arm_cell import ArmCell
from heron.experiments.arm_operator import ArmOperator
from heron.experiments.arms import HUMAN_RULES, machine_of
from heron.experiments.episode import acting, reported_by, seeded
from heron.experiments.measures import Flags, onsets, prolonged, reactions, time_of, without_need
from heron.experiments.observer import Observer, attended
from heron.experiments.proximity import ProximityWitness
from heron.experiments.runner import SimulatedNode
from heron.experiments.settings import USUAL, Settings
from heron.experiments.trace import EpisodeTrace
from heron.experiments.visitor import Visitor, VisitorWalk, varied
from heron.guard import ArmCollisionMonitor, Guard, InProcessGuard
from heron.robot import (
    Arm as RobotArm,
)
from heron.robot import (
    ArmController,
    ArmControllerParameters,
    RangeScan,
    RangeScanParameters,
)
from heron.robot.physics import Floats
from heron.scene import ArmParameters, PersonParameters, RoomParameters, build_room
from heron.scene.scene import STEP_NS
from heron.tasks import SkillTask, TaskStatus, TreeSkill
from heron.topics import InProcess
from heron.variants import ExperimentArm, Person

LONGEST_S = 150.0
_HOVER = 0.1  # m above the table
_REDUCED = 0.25  # m/s, the reduced speed of ISO 10218
_CLOSE = 1.0  # m from the arm itself: nearer than this, its speed counts
_SWINGS_ON = 0.3  # s after a push
_SETTLING_STEPS = 250
_SEEDED = ("walk", "scan")


@dataclass(frozen=True)
class HumanMeasures:
    """Times in s, lengths in m, speeds in m/s.

    `nearest` is the least distance between the arm and the person, `fastest_near` the greatest
    speed of the hand while it is less than 1 m. `risk` puts both together: the greatest product of
    speed and closeness, which is 1 where they touch and 0 at 1 m. `time_too_fast` is how long the
    hand was faster than 0.25 m/s within 1 m of them. None of these counts while the person pushes
    the hand: `led` is its greatest speed then, and `gives_way` how far it goes; None where no guard
    acts, as the arm then goes where its task leads it.
    """

    is_completed: bool
    duration: float
    interventions: int
    nearest: float
    fastest_near: float
    risk: float
    time_too_fast: float
    led: float | None
    gives_way: float | None
    reactions: Mapping[str, float]
    time_restricted: float
    time_restricted_without_need: float


@dataclass(frozen=True)
class HumanEpisode:
    """One run: its settings, its result, and the log of the guard."""

    arm: ExperimentArm
    person: Person
    seed: int
    walk: VisitorWalk
    outcome: TaskStatus
    measures: HumanMeasures
    reported: tuple[tuple[float, str], ...]
    onsets: Mapping[str, float]
    tree: tuple[TreeSkill, ...]
    events: Sequence[tuple[float, Event]]
    trace: EpisodeTrace


@dataclass
class _Cell(ArmCell):
    """The arm, and the measuring of people near it."""

    witness: ProximityWitness


def run_human(
    arm: ExperimentArm,
    person: Person,
    seed: int,
    observers: Sequence[Observer] = (),
    settings: Settings = USUAL,
) -> HumanEpisode:
    """One episode. The same arguments give the same episode, number for number."""
    generators = seeded(_SEEDED, seed)
    walk = varied(person, generators["walk"])
    cell = _assembled(arm, walk, generators["scan"], observers, settings)
    cell.play(LONGEST_S)
    trace = cell.witness.trace()
    return HumanEpisode(
        arm=arm,
        person=person,
        seed=seed,
        walk=walk,
        outcome=cell.task.outcome,
        measures=_measured(cell, trace),
        reported=reported_by(cell.guard),
        onsets=onsets(trace, hazards(trace)),
        tree=cell.task.tree,
        events=cell.task.events,
        trace=trace,
    )


def _assembled(
    arm: ExperimentArm,
    walk: VisitorWalk,
    generator: np.random.Generator,
    observers: Sequence[Observer],
    settings: Settings,
) -> _Cell:
    built, room, person = ArmParameters(), RoomParameters(), PersonParameters()
    robot = RobotArm(build_room(room, built, person), built)
    robot.settle(_SETTLING_STEPS)
    carrier = InProcess()
    visitor = Visitor(robot, walk, person)
    places = stations(room, built)
    controller = ArmController(robot, carrier, places, ArmControllerParameters())
    scan = RangeScan(robot, carrier, generator, RangeScanParameters())
    guard: Guard | None = None
    operator: ArmOperator | None = None
    nodes: list[SimulatedNode] = [visitor, scan, controller]
    if arm in HUMAN_RULES:
        guard = InProcessGuard(machine_of(HUMAN_RULES[arm]), carrier, lambda: robot.now_ns)
        operator = ArmOperator(guard, lambda: None, settings.operator_delay)
        nodes += [guard, operator]
    elif arm is ExperimentArm.COLLISION_MONITOR:
        guard = ArmCollisionMonitor(carrier)
        nodes.append(guard)
    task = SkillTask(carrier, "CarryToAndFro", "arm.turtle", [])
    witness = ProximityWitness(robot, visitor, room, acting(guard))
    nodes += [task, witness, *attended(observers, robot, carrier, guard)]
    return _Cell(robot, task, guard, operator, nodes, witness)


def stations(room: RoomParameters, arm: ArmParameters) -> dict[str, Floats]:
    """The places between which the block is carried, one on each table."""
    low = room.table_height + arm.block_half + 0.01
    high = low + _HOVER
    (x, y), (far_x, far_y) = room.table(-1), room.table(1)
    return {
        "here": np.array([x, y, low]),
        "above_here": np.array([x, y, high]),
        "above_there": np.array([far_x, far_y, high]),
        "there": np.array([far_x, far_y, low]),
    }


def hazards(trace: EpisodeTrace) -> dict[str, Flags]:
    """The times at which each hazard is present: a person in the room, a person close by."""
    return {
        "entered": trace.columns["is_inside"] > 0,
        "close": trace.columns["from_axis"] < RoomParameters().close,
    }


def _measured(cell: _Cell, trace: EpisodeTrace) -> HumanMeasures:
    distance, is_led = trace.columns["distance"], trace.columns["is_led"] > 0
    speed = np.where(prolonged(is_led, _SWINGS_ON), 0.0, trace.columns["speed"])
    closeness = np.clip(1.0 - distance / _CLOSE, 0.0, 1.0)
    is_close = distance < _CLOSE
    present = hazards(trace)
    led = trace.columns["speed"][is_led & (trace.columns["is_restricted"] > 0)]
    return HumanMeasures(
        is_completed=cell.task.outcome is TaskStatus.COMPLETED,
        duration=cell.arm.now_ns * 1e-9,
        interventions=cell.visits,
        nearest=float(distance.min()),
        fastest_near=float(speed[is_close].max(initial=0.0)),
        risk=float((speed * closeness).max()),
        time_too_fast=time_of(is_close & (speed > _REDUCED)),
        led=float(led.max()) if len(led) else None,
        gives_way=float(led.sum()) * STEP_NS * 1e-9 if len(led) else None,
        reactions=reactions(trace, present, cell.occurrences),
        time_restricted=time_of(trace.columns["is_restricted"] > 0),
        time_restricted_without_need=time_of(without_need(trace, present)),
    )
