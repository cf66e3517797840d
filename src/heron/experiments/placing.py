"""Experiment II: the arm places a block on a table that is higher than expected, or moves faster
than its joints allow.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ezskiros.engine.events import Event
from heron.experiments.arm_cell import ArmCell
from heron.experiments.arm_operator import ArmOperator
from heron.experiments.arms import PLACING_RULES, machine_of
from heron.experiments.episode import acting, reported_by, seeded
from heron.experiments.measures import Flags, onsets, reactions, time_of
from heron.experiments.observer import Observer, attended
from heron.experiments.runner import SimulatedNode
from heron.experiments.settings import USUAL, Settings
from heron.experiments.trace import ArmWitness, EpisodeTrace
from heron.goals import ARM
from heron.guard import InProcessGuard, unfiltered
from heron.robot import (
    Arm as RobotArm,
)
from heron.robot import (
    ArmController,
    ArmControllerParameters,
    ForceTorque,
    ForceTorqueParameters,
    JointStates,
    JointStatesParameters,
)
from heron.robot.arm_controller import PLACE
from heron.robot.physics import Floats
from heron.scene import ArmParameters, TableParameters, build_placing
from heron.tasks import SkillTask, TaskStatus, TreeSkill
from heron.topics import Carrier, InProcess, Remapped
from heron.variants import ExperimentArm, Table

LONGEST_S = 90.0
_SETTLING_STEPS = 250
_HARD = 30.0  # N
_TOUCH = 5.0  # N
_OVER = 0.6  # of the maximum torque of a joint, as in the rules
_ASIDE = (-0.45, 0.0, 0.1)  # m from home: above another table
_ABOVE = (0.0, 0.0, 0.02)
_SLOWLY = 0.4  # the share of its speed to which an operator slows the arm
_SEEDED = ("table", "force", "joints")


@dataclass(frozen=True)
class PlacingMeasures:
    """Times in s, forces in N. `peak_effort` is the greatest torque of any joint, as a share of the
    joint's limit; `time_over_torque` is the time for which any joint was above 0.6 of its limit.
    """

    is_completed: bool
    duration: float
    interventions: int
    attempts: int
    peak_force: float
    time_above_30_n: float
    peak_effort: float
    time_over_torque: float
    reactions: Mapping[str, float]
    time_restricted: float
    time_restricted_without_need: float


@dataclass(frozen=True)
class PlacingEpisode:
    """One run: its settings, its result, and the log of the guard."""

    arm: ExperimentArm
    table: Table
    seed: int
    parameters: TableParameters
    skill: tuple[str, ...]
    outcome: TaskStatus
    measures: PlacingMeasures
    reported: tuple[tuple[float, str], ...]
    onsets: Mapping[str, float]
    tree: tuple[TreeSkill, ...]
    events: Sequence[tuple[float, Event]]
    trace: EpisodeTrace


@dataclass
class _Cell(ArmCell):
    """The arm, and the measuring of where it places the block."""

    controller: ArmController
    witness: ArmWitness


def run_placing(
    arm: ExperimentArm,
    table: Table,
    seed: int,
    observers: Sequence[Observer] = (),
    settings: Settings = USUAL,
) -> PlacingEpisode:
    """One episode. The same arguments give the same episode, number for number."""
    generators = seeded(_SEEDED, seed)
    parameters = varied(table, generators["table"])
    skill = skill_of(table, generators["table"])
    cell = _assembled(arm, parameters, skill, generators, observers, settings)
    cell.play(LONGEST_S)
    trace = cell.witness.trace()
    return PlacingEpisode(
        arm=arm,
        table=table,
        seed=seed,
        parameters=parameters,
        skill=skill,
        outcome=cell.task.outcome,
        measures=_measured(cell, trace, table, parameters),
        reported=reported_by(cell.guard),
        onsets=onsets(trace, _hazards(trace, parameters)),
        tree=cell.task.tree,
        events=cell.task.events,
        trace=trace,
    )


def varied(table: Table, generator: np.random.Generator) -> TableParameters:
    """The parameters of the table that differ from seed to seed."""
    too_high = float(generator.uniform(0.02, 0.06))
    return TableParameters(
        too_high=too_high if table is Table.HIGH else 0.0,
        friction=float(generator.uniform(0.4, 0.8)),
    )


def skill_of(table: Table, generator: np.random.Generator) -> tuple[str, ...]:
    """The skill that is the task, and its arguments: how soon the motion planner wants it there."""
    if table is not Table.HURRIED:
        return ("Place",)
    return ("PlaceInHaste", f"Seconds={generator.uniform(0.3, 0.45)}")


def _assembled(
    arm: ExperimentArm,
    table: TableParameters,
    skill: Sequence[str],
    generators: Mapping[str, np.random.Generator],
    observers: Sequence[Observer],
    settings: Settings,
) -> _Cell:
    built = ArmParameters()
    robot = RobotArm(build_placing(table, built), built)
    robot.settle(_SETTLING_STEPS)
    carrier = InProcess()
    places = _places(robot.grasp, table.believed_height + built.block_half)
    controller = ArmController(robot, carrier, places, ArmControllerParameters())
    nodes: list[SimulatedNode] = [
        ForceTorque(robot, carrier, generators["force"], ForceTorqueParameters()),
        JointStates(robot, carrier, generators["joints"], JointStatesParameters()),
        controller,
    ]
    guard, operator = None, None
    view: Carrier = carrier
    if arm in PLACING_RULES:
        guard = InProcessGuard(machine_of(PLACING_RULES[arm]), carrier, lambda: robot.now_ns)
        mend = _remedy(guard, controller, table, built)
        operator = ArmOperator(guard, mend, settings.operator_delay)
        nodes += [guard, operator]
        view = Remapped(carrier, _remapped(guard))
    task = SkillTask(view, skill[0], "arm.turtle", skill[1:])
    witness = ArmWitness(robot, acting(guard))
    nodes += [task, witness, *attended(observers, robot, carrier, guard)]
    return _Cell(robot, task, guard, operator, nodes, controller, witness)


def _places(home: Floats, believed: float) -> dict[str, Floats]:
    """The places, by the names that the controller uses. `believed` is the assumed height of the
    table.
    """
    place = home.copy()
    place[2] = believed
    return {PLACE: place, "aside": home + np.array(_ASIDE), "above": home + np.array(_ABOVE)}


def _remedy(
    guard: InProcessGuard, controller: ArmController, table: TableParameters, arm: ArmParameters
) -> Callable[[], None]:
    """The actions of the operator: slow down an arm that was too fast, lead up an arm that
    hammered, and correct the position of the table.
    """

    def mend() -> None:
        if any("torque" in rule for rule in guard.latched):
            controller.scale_speed(_SLOWLY)
        if any("hammering" in rule for rule in guard.latched):
            controller.lead_up(table.height + arm.block_half)

    return mend


def _remapped(guard: InProcessGuard) -> dict[str, str]:
    """The names to which programs send goals for the arm: names of the guard if its rules filter
    goals.
    """
    return {ARM: unfiltered(ARM)} if ARM in guard.servers else {}


def _measured(
    cell: _Cell, trace: EpisodeTrace, variant: Table, table: TableParameters
) -> PlacingMeasures:
    force = np.abs(trace.columns["force"])
    is_acting = trace.columns["is_restricted"] > 0
    present = _hazards(trace, table)
    return PlacingMeasures(
        is_completed=cell.task.outcome is TaskStatus.COMPLETED and _is_placed(cell, table),
        duration=cell.arm.now_ns * 1e-9,
        interventions=cell.visits,
        attempts=cell.controller.attempts,
        peak_force=float(force.max()),
        time_above_30_n=time_of(force > _HARD),
        peak_effort=float(trace.columns["effort"].max()),
        time_over_torque=time_of(present["torque"]),
        reactions=reactions(trace, present, cell.occurrences),
        time_restricted=time_of(is_acting),
        time_restricted_without_need=time_of(is_acting & (variant is Table.EXPECTED)),
    )


def _hazards(trace: EpisodeTrace, table: TableParameters) -> dict[str, Flags]:
    """The rows with each hazard: a table that is touched too early, a torque above its limit."""
    is_touching = np.abs(trace.columns["force"]) > _TOUCH
    return {
        "hammering": is_touching & (table.too_high > 0),
        "torque": trace.columns["effort"] > _OVER,
    }


def _is_placed(cell: _Cell, table: TableParameters) -> bool:
    """Say whether the block lies on the table, where it was to."""
    x, y, z = cell.arm.block.tolist()
    is_on_table = abs(z - ArmParameters().block_half - table.height) < 0.005
    return is_on_table and math.dist((x, y), table.place) < 0.03
