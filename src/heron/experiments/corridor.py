"""Experiment V: the robot drives along a corridor, a part of which belongs to a school. A child
runs out of a door.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ezskiros.engine.events import Event
from heron.experiments.arms import CORRIDOR_RULES, machine_of
from heron.experiments.child import Dash, WalkingChild, varied
from heron.experiments.episode import reported_by, seeded
from heron.experiments.measures import Flags, onsets, time_of, without_need
from heron.experiments.moving_base import FAR, SEEDED, NearnessWitness, base_nodes
from heron.experiments.observer import Observer, attended
from heron.experiments.runner import SimulatedNode, run
from heron.experiments.settings import USUAL, Settings
from heron.experiments.trace import EpisodeTrace
from heron.guard import InProcessGuard, unfiltered
from heron.robot import Base
from heron.scene import CHILD, BaseParameters, CorridorParameters, build_corridor
from heron.scene.person import LEGS, PERSON
from heron.tasks import (
    Navigation,
    NavigationParameters,
    SkillContextPublisher,
    SkillTask,
    TaskStatus,
    TreeSkill,
)
from heron.topics import COMMAND, Carrier, InProcess, Remapped
from heron.variants import ExperimentArm, Passage
from rossmarie.ir import TaskCommandKind

LONGEST_S = 120.0
BRISK = NavigationParameters(cruise=1.0)
"""The speed of the base where no people are."""
_TOUCHING = 0.02  # m
_NEAR = 0.5  # m
_STANDS = 0.02  # m/s
_SETTLING_STEPS = 500


@dataclass(frozen=True)
class CorridorMeasures:
    """Times in s, lengths in m, speeds in m/s.

    `nearest` is the least distance between the base and the child, `fastest_near` the greatest
    speed of the base while that is less than half a metre, and `impact` that while they touch: 0
    where the base stands before. They are None where there is no child.
    """

    is_completed: bool
    duration: float
    interventions: int
    nearest: float | None
    fastest_near: float | None
    impact: float | None
    reactions: Mapping[str, float]
    time_restricted: float
    time_restricted_without_need: float


@dataclass(frozen=True)
class CorridorEpisode:
    """One run: its settings, its result, and the log of the guard."""

    arm: ExperimentArm
    passage: Passage
    seed: int
    dash: Dash | None
    outcome: TaskStatus
    measures: CorridorMeasures
    reported: tuple[tuple[float, str], ...]
    onsets: Mapping[str, float]
    tree: tuple[TreeSkill, ...]
    events: Sequence[tuple[float, Event]]
    trace: EpisodeTrace


@dataclass
class _Robot:
    """The parts of an episode."""

    physics: Base
    task: SkillTask
    guard: InProcessGuard | None
    witness: NearnessWitness
    nodes: list[SimulatedNode]


def run_corridor(
    arm: ExperimentArm,
    passage: Passage,
    seed: int,
    observers: Sequence[Observer] = (),
    settings: Settings = USUAL,  # noqa: ARG001
) -> CorridorEpisode:
    """One episode. The same arguments give the same episode, number for number."""
    generators = seeded(("child", *SEEDED), seed)
    dash = varied(passage, generators["child"])
    robot = _assembled(arm, dash, generators, observers)
    run(
        robot.physics,
        robot.nodes,
        round(LONGEST_S * 1e9),
        lambda: robot.task.outcome is not TaskStatus.RUNNING,
    )
    trace = robot.witness.trace()
    return CorridorEpisode(
        arm=arm,
        passage=passage,
        seed=seed,
        dash=dash,
        outcome=robot.task.outcome,
        measures=_measured(robot, dash, trace),
        reported=reported_by(robot.guard),
        onsets=onsets(trace, hazards(trace)),
        tree=robot.task.tree,
        events=robot.task.events,
        trace=trace,
    )


def _assembled(
    arm: ExperimentArm,
    dash: Dash | None,
    generators: Mapping[str, np.random.Generator],
    observers: Sequence[Observer],
) -> _Robot:
    base, corridor = BaseParameters(), CorridorParameters()
    physics = Base(build_corridor(corridor, base, CHILD))
    physics.settle(_SETTLING_STEPS)
    carrier = InProcess()
    half = base.chassis_half[0]
    child = WalkingChild(physics, corridor, CHILD, dash, lambda: float(physics.position[0]) + half)
    nodes = [child, *base_nodes(physics, carrier, base, generators)]
    guard = None
    view: Carrier = carrier
    if arm in CORRIDOR_RULES:
        guard = InProcessGuard(machine_of(CORRIDOR_RULES[arm]), carrier, lambda: physics.now_ns)
        nodes.append(guard)
        view = Remapped(carrier, {COMMAND.name: unfiltered(COMMAND.name)})
    route = ((corridor.begin, 0.0), (corridor.end, 0.0))
    navigation = Navigation(view, (route,), BRISK, lambda: physics.now_ns)
    task = SkillTask(carrier, "Drive", "corridor.turtle", ["Target=classroom"])
    witness = NearnessWitness(
        physics,
        physics.geoms((PERSON, *LEGS)),
        guard,
        ("is_there", lambda: child.is_in_corridor),
        lambda: abs(float(physics.position[0]) - child.place[0]) < 2 * FAR,
    )
    nodes += [task, SkillContextPublisher(carrier, task), navigation, witness]
    nodes += attended(observers, physics, carrier, guard)
    return _Robot(physics, task, guard, witness, nodes)


def hazards(trace: EpisodeTrace) -> dict[str, Flags]:
    """The instants with each hazard: a child is in the corridor."""
    return {"child": trace.columns["is_there"] > 0}


def _measured(robot: _Robot, dash: Dash | None, trace: EpisodeTrace) -> CorridorMeasures:
    distance, speed = trace.columns["distance"], trace.columns["speed"]
    present = hazards(trace)
    is_moving = speed > _STANDS

    def fastest(within: float) -> float | None:
        near = (distance < within) & is_moving
        return None if dash is None else float(speed[near].max(initial=0.0))

    return CorridorMeasures(
        is_completed=robot.task.outcome is TaskStatus.COMPLETED,
        duration=robot.physics.now_ns * 1e-9,
        interventions=0,
        nearest=None if dash is None else float(distance.min()),
        fastest_near=fastest(_NEAR),
        impact=fastest(_TOUCHING),
        reactions=_reactions(robot.guard, trace, present),
        time_restricted=time_of(trace.columns["is_restricted"] > 0),
        time_restricted_without_need=time_of(without_need(trace, present)),
    )


def _reactions(
    guard: InProcessGuard | None, trace: EpisodeTrace, present: Mapping[str, Flags]
) -> dict[str, float]:
    """The time from the appearance of the child to the first action of the rule that stops the
    base.
    """
    if guard is None:
        return {}
    starts = [
        each.at_ns * 1e-9
        for each in guard.occurrences
        if each.kind is TaskCommandKind.START and each.rule == "stop_when_close"
    ]
    found = {}
    for hazard, onset in onsets(trace, present).items():
        after = [at for at in starts if at >= onset]
        if after:
            found[hazard] = after[0] - onset
    return found
