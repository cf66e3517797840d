"""Experiment VI, a blocked route: two routes lead to a hall, and an obstacle blocks one.

Experiment VII delivers in the same scene.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ezskiros.engine.events import Event
from ezskiros.learning.lessons import Cost
from heron.experiments.arms import BLOCKED_RULES, machine_of
from heron.experiments.clearing_operator import ClearingOperator
from heron.experiments.episode import reported_by, seeded
from heron.experiments.measures import Flags, onsets, time_of, without_need
from heron.experiments.moving_base import SEEDED, NearnessWitness, base_nodes
from heron.experiments.observer import Observer, attended
from heron.experiments.obstacles import Obstacle, Obstacles, varied
from heron.experiments.runner import SimulatedNode, run
from heron.experiments.settings import USUAL, Settings
from heron.experiments.trace import EpisodeTrace
from heron.guard import InProcessGuard, unfiltered
from heron.robot import Base
from heron.scene import BaseParameters, PathsParameters, build_paths
from heron.tasks import (
    LookOut,
    LookOutParameters,
    NavigationParameters,
    PlaceNavigation,
    SkillContextPublisher,
    SkillTask,
    TaskStatus,
    TreeSkill,
)
from heron.topics import COMMAND, Carrier, InProcess, Remapped
from heron.variants import Blockage, ExperimentArm, Trouble
from rossmarie.ir import Change, TaskCommandKind

LONGEST_S = 300.0
PATIENT = NavigationParameters(patience=120.0)
"""The base waits for an operator and does not give up before."""
_SETTLING_STEPS = 500
_HALL, _JUNCTION, _YARD = "heron:Place-4", "heron:Place-3", "heron:Place-5"


@dataclass(frozen=True)
class BlockedMeasures:
    """Times in s, lengths in m. `activations` counts the activations of rules by their conditions,
    and `replanned` counts reroutes and new plans. `nearest` is the smallest distance between the
    base and an obstacle, and `touched` is the duration of their contact.
    """

    is_completed: bool
    duration: float
    interventions: int
    activations: int
    replanned: int
    nearest: float
    touched: float
    reactions: Mapping[str, float]
    time_restricted: float
    time_restricted_without_need: float


@dataclass(frozen=True)
class Delivery:
    """The settings of an episode. With `costs` of skills, which may be empty, the planner finds the
    route to the hall; without, the route is straight on.
    """

    arm: ExperimentArm
    variant: Blockage | Trouble
    seed: int
    obstacles: tuple[Obstacle, ...]
    costs: Sequence[Cost] | None = None


@dataclass(frozen=True)
class BlockedEpisode:
    """One run: its settings, its result, and the log of the guard."""

    arm: ExperimentArm
    variant: Blockage | Trouble
    seed: int
    obstacles: tuple[Obstacle, ...]
    outcome: TaskStatus
    measures: BlockedMeasures
    reported: tuple[tuple[float, str], ...]
    onsets: Mapping[str, float]
    tree: tuple[TreeSkill, ...]
    events: Sequence[tuple[float, Event]]
    trace: EpisodeTrace


@dataclass
class _Robot:
    """The parts of an episode."""

    physics: Base
    navigation: PlaceNavigation
    task: SkillTask
    guard: InProcessGuard | None
    operator: ClearingOperator
    witness: NearnessWitness
    nodes: list[SimulatedNode]


def run_blocked(
    arm: ExperimentArm,
    blockage: Blockage,
    seed: int,
    observers: Sequence[Observer] = (),
    settings: Settings = USUAL,
) -> BlockedEpisode:
    """One episode. The same arguments give the same episode, number for number."""
    generators = seeded_generators(seed)
    obstacles = varied(blockage, PathsParameters(), generators["obstacles"])
    return delivered(Delivery(arm, blockage, seed, obstacles), generators, observers, settings)


def seeded_generators(seed: int) -> dict[str, np.random.Generator]:
    """The random generators of an episode. `obstacles` generates the obstacles on the path."""
    return seeded(("obstacles", *SEEDED), seed)


def delivered(
    delivery: Delivery,
    generators: Mapping[str, np.random.Generator],
    observers: Sequence[Observer],
    settings: Settings,
) -> BlockedEpisode:
    """The episode in which something is delivered."""
    robot = _assembled(delivery, generators, settings, observers)
    run(
        robot.physics,
        robot.nodes,
        round(LONGEST_S * 1e9),
        lambda: robot.task.outcome is not TaskStatus.RUNNING,
    )
    trace = robot.witness.trace()
    return BlockedEpisode(
        arm=delivery.arm,
        variant=delivery.variant,
        seed=delivery.seed,
        obstacles=delivery.obstacles,
        outcome=robot.task.outcome,
        measures=_measured(robot, trace),
        reported=reported_by(robot.guard),
        onsets=onsets(trace, hazards(trace)),
        tree=robot.task.tree,
        events=robot.task.events,
        trace=trace,
    )


def _assembled(
    delivery: Delivery,
    generators: Mapping[str, np.random.Generator],
    settings: Settings,
    observers: Sequence[Observer],
) -> _Robot:
    base, paths, across = BaseParameters(), PathsParameters(), delivery.obstacles
    physics = Base(build_paths(paths, base, [each.name for each in across]))
    obstacles = Obstacles(physics, across)
    physics.settle(_SETTLING_STEPS)
    carrier = InProcess()

    def clock() -> int:
        return physics.now_ns

    nodes = [obstacles, *base_nodes(physics, carrier, base, generators)]
    guard = None
    view: Carrier = carrier
    if delivery.arm in BLOCKED_RULES:
        guard = InProcessGuard(machine_of(BLOCKED_RULES[delivery.arm]), carrier, clock)
        nodes.append(guard)
        view = Remapped(carrier, {COMMAND.name: unfiltered(COMMAND.name)})
    look_out = LookOut(carrier, LookOutParameters(), clock)
    navigation = PlaceNavigation(view, _routes(paths), PATIENT, clock, lambda: look_out.is_blocked)
    scene, place = "blocked.turtle", [f"Place={_HALL}"]
    task = SkillTask(carrier, "Deliver", scene, place, delivery.costs)
    operator = ClearingOperator(physics, obstacles, settings.operator_delay)
    geoms = [physics.model.geom(each.name).id for each in across]
    hazard = ("is_blocked", lambda: obstacles.is_blocked)
    witness = NearnessWitness(physics, geoms, guard, hazard, lambda: bool(geoms))
    nodes += [task, SkillContextPublisher(carrier, task), look_out, navigation, operator, witness]
    nodes += attended(observers, physics, carrier, guard)
    return _Robot(physics, navigation, task, guard, operator, witness, nodes)


def _routes(paths: PathsParameters) -> dict[str, tuple[tuple[tuple[float, float], ...], ...]]:
    """The routes to each place, from the previous place. Navigation alone knows the second route to
    the hall. Plans of skills lead to the hall through the yard.
    """
    return {
        _JUNCTION: ((paths.junction,),),
        _YARD: ((paths.yard,),),
        _HALL: ((paths.hall,), (paths.junction, paths.yard, paths.hall)),
    }


def hazards(trace: EpisodeTrace) -> dict[str, Flags]:
    """The instants with each hazard: the base is at the obstacle on its path."""
    return {"blocked": trace.columns["is_blocked"] > 0}


def _measured(robot: _Robot, trace: EpisodeTrace) -> BlockedMeasures:
    distance = trace.columns["distance"]
    present = hazards(trace)
    return BlockedMeasures(
        is_completed=robot.task.outcome is TaskStatus.COMPLETED,
        duration=robot.physics.now_ns * 1e-9,
        interventions=robot.operator.visits,
        activations=_activations(robot.guard),
        replanned=robot.navigation.replanned + robot.task.replanned,
        nearest=float(distance.min()),
        touched=time_of(distance <= 0),
        reactions=_reactions(robot.guard, trace, present),
        time_restricted=time_of(trace.columns["is_restricted"] > 0),
        time_restricted_without_need=time_of(without_need(trace, present)),
    )


def _activations(guard: InProcessGuard | None) -> int:
    found = guard.verdicts if guard is not None else ()
    return sum(each.change is Change.ACTIVATED for each in found)


def _reactions(
    guard: InProcessGuard | None, trace: EpisodeTrace, present: Mapping[str, Flags]
) -> dict[str, float]:
    """The time from when the base meets an obstacle to the first action of a rule."""
    if guard is None:
        return {}
    starts = [each.at_ns * 1e-9 for each in guard.occurrences if each.kind is TaskCommandKind.START]
    found = onsets(trace, present).items()
    return {hazard: starts[0] - onset for hazard, onset in found if starts}
