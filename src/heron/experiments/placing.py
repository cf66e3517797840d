"""Experiment II: the arm places a block on a table that is higher than it believes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from heron.experiments.arm_operator import ArmOperator
from heron.experiments.arms import PLACING_RULES, machine_of
from heron.experiments.episode import told_by
from heron.experiments.measures import reactions, time_of
from heron.experiments.runner import Node, run
from heron.experiments.trace import ArmWitness, Trace
from heron.guard import Guard, unfiltered
from heron.robot import (
    Arm as RobotArm,
)
from heron.robot import (
    ArmController,
    ArmControllerParameters,
    ForceTorque,
    ForceTorqueParameters,
)
from heron.scene import ArmParameters, TableParameters, build_placing
from heron.tasks import Outcome, Placing
from heron.topics import ARM, Carrier, InProcess, Remapped
from heron.variants import Arm, Table

LONGEST_S = 90.0
_SETTLING_STEPS = 250
_HARD = 30.0  # N
_TOUCH = 5.0  # N
_SEEDED = ("table", "force")


@dataclass(frozen=True)
class PlacingMeasures:
    """Times in s, forces in N. `peak_effort` is the greatest torque of any joint, as a share of
    what the joint may give.
    """

    is_completed: bool
    duration: float
    interventions: int
    attempts: int
    peak_force: float
    time_above_30_n: float
    peak_effort: float
    reactions: Mapping[str, float]
    time_restricted: float
    time_restricted_without_need: float


@dataclass(frozen=True)
class PlacingEpisode:
    """One run: what was run, how it went, and what the guard had to say."""

    arm: Arm
    table: Table
    seed: int
    parameters: TableParameters
    outcome: Outcome
    measures: PlacingMeasures
    told: tuple[tuple[float, str], ...]
    trace: Trace


@dataclass
class _Cell:
    """All that takes part in an episode."""

    arm: RobotArm
    controller: ArmController
    task: Placing
    guard: Guard | None
    operator: ArmOperator | None
    witness: ArmWitness
    nodes: list[Node]


def run_placing(arm: Arm, table: Table, seed: int) -> PlacingEpisode:
    """One episode. The same arguments give the same episode, number for number."""
    sources = np.random.SeedSequence(seed).spawn(len(_SEEDED))
    generators = dict(zip(_SEEDED, map(np.random.default_rng, sources), strict=True))
    parameters = varied(table, generators["table"])
    cell = _assembled(arm, parameters, generators["force"])
    run(
        cell.arm,
        cell.nodes,
        round(LONGEST_S * 1e9),
        lambda: cell.task.outcome is not Outcome.RUNNING,
    )
    trace = cell.witness.trace()
    return PlacingEpisode(
        arm=arm,
        table=table,
        seed=seed,
        parameters=parameters,
        outcome=cell.task.outcome,
        measures=_measured(cell, trace, parameters),
        told=told_by(cell.guard),
        trace=trace,
    )


def varied(table: Table, generator: np.random.Generator) -> TableParameters:
    """What differs from seed to seed of the table."""
    too_high = float(generator.uniform(0.02, 0.06))
    return TableParameters(
        too_high=too_high if table is Table.HIGH else 0.0,
        friction=float(generator.uniform(0.4, 0.8)),
    )


def _assembled(arm: Arm, table: TableParameters, generator: np.random.Generator) -> _Cell:
    built = ArmParameters()
    robot = RobotArm(build_placing(table, built), built)
    robot.settle(_SETTLING_STEPS)
    carrier = InProcess()
    believed = robot.grasp.copy()
    believed[2] = table.believed_height + built.block_half
    sensor = ForceTorque(robot, carrier, generator, ForceTorqueParameters())
    controller = ArmController(robot, carrier, believed, ArmControllerParameters())
    guard, operator = None, None
    view: Carrier = carrier
    nodes: list[Node] = [sensor, controller]
    if arm is not Arm.NONE:
        guard = Guard(machine_of(PLACING_RULES[arm]), carrier, lambda: robot.now_ns)
        operator = ArmOperator(guard, controller, table.height + built.block_half)
        nodes += [guard, operator]
        view = Remapped(carrier, _remapped(guard))
    task = Placing(view)
    witness = ArmWitness(robot, lambda: guard is not None and guard.is_acting)
    nodes += [task, witness]
    return _Cell(robot, controller, task, guard, operator, witness, nodes)


def _remapped(guard: Guard) -> dict[str, str]:
    """Where programs send goals for the arm: to the guard, if its rules have a say in them."""
    return {ARM: unfiltered(ARM)} if ARM in guard.servers else {}


def _measured(cell: _Cell, trace: Trace, table: TableParameters) -> PlacingMeasures:
    force = np.abs(trace.columns["force"])
    is_acting = trace.columns["is_restricted"] > 0
    guard, operator = cell.guard, cell.operator
    present = {"hammering": (force > _TOUCH) & (table.too_high > 0)}
    return PlacingMeasures(
        is_completed=cell.task.outcome is Outcome.COMPLETED and _is_placed(cell, table),
        duration=cell.arm.now_ns * 1e-9,
        interventions=0 if operator is None else operator.summons.visits,
        attempts=cell.controller.attempts,
        peak_force=float(force.max()),
        time_above_30_n=time_of(force > _HARD),
        peak_effort=float(trace.columns["effort"].max()),
        reactions=reactions(trace, present, [] if guard is None else guard.occurrences),
        time_restricted=time_of(is_acting),
        time_restricted_without_need=0.0 if table.too_high > 0 else time_of(is_acting),
    )


def _is_placed(cell: _Cell, table: TableParameters) -> bool:
    """Whether the block lies on the table, where it was to."""
    x, y, z = cell.arm.block.tolist()
    is_on_table = abs(z - ArmParameters().block_half - table.height) < 0.005
    return is_on_table and math.dist((x, y), table.place) < 0.03
