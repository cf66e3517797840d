"""Experiment I: through a corridor with a bump, up a ramp, to pick up a block in the room."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ezskiros.engine.events import Event
from heron.experiments.arms import NAVIGATION_RULES, machine_of
from heron.experiments.base_operator import BaseOperator, BaseOperatorParameters
from heron.experiments.episode import reported_by, seeded
from heron.experiments.measures import (
    NavigationMeasures,
    hazards,
    onsets,
    peaks,
    reactions,
    time_of,
    without_need,
)
from heron.experiments.moving_base import base_nodes
from heron.experiments.observer import Observer, attended
from heron.experiments.picking import Standing, pick_up
from heron.experiments.runner import SimulatedNode, run
from heron.experiments.settings import USUAL, Settings
from heron.experiments.trace import BaseWitness, EpisodeTrace
from heron.guard import BaseCollisionMonitor, Guard, InProcessLink, Link, unfiltered
from heron.robot import Base, Imu, ImuParameters
from heron.scene import BaseParameters, Course, CourseParameters, build_navigation, course
from heron.tasks import Navigation, NavigationParameters, SkillTask, TaskStatus, TreeSkill
from heron.topics import COMMAND, Carrier, InProcess, Remapped
from heron.variants import ExperimentArm, Terrain

LONGEST_S = 240.0
_SETTLING_STEPS = 500
_NEARLY = 0.98  # of the usual limit of torque
_SEEDED = ("course", "imu", "odometry", "localization", "picking", "joints", "scan")


@dataclass(frozen=True)
class NavigationEpisode:
    """One run: its settings, its result, and the log of the guard."""

    arm: ExperimentArm
    terrain: Terrain
    seed: int
    course: Course
    outcome: TaskStatus
    measures: NavigationMeasures
    reported: tuple[tuple[float, str], ...]
    onsets: Mapping[str, float]
    tree: tuple[TreeSkill, ...]
    events: Sequence[tuple[float, Event]]
    trace: EpisodeTrace


@dataclass
class _Robot:
    """The parts of an episode."""

    physics: Base
    carrier: InProcess
    navigation: Navigation
    task: SkillTask
    guard: Guard | None
    operator: BaseOperator | None
    witness: BaseWitness
    nodes: list[SimulatedNode]

    def standing(self) -> Standing:
        """The second part of the experiment, after the base has arrived."""
        over = (self.task, self.operator)
        nodes = [node for node in self.nodes if node not in over]
        return Standing(self.physics, nodes, self.guard)


def run_navigation(
    arm: ExperimentArm,
    terrain: Terrain,
    seed: int,
    observers: Sequence[Observer] = (),
    settings: Settings = USUAL,
    link: Link | None = None,
) -> NavigationEpisode:
    """One episode, in this process if no other link is given. The same arguments give the same
    episode, number for number.
    """
    generators = seeded(_SEEDED, seed)
    built = course(terrain, varied(generators["course"]))
    robot = _assembled(arm, built, settings, generators, link or InProcessLink())
    _drive(robot, observers)
    measures = _measured(robot, built)
    if robot.navigation.outcome is TaskStatus.COMPLETED:
        picked = pick_up(robot.standing(), built, robot.task, generators, observers)
        duration = measures.duration + picked.seconds
        measures = replace(measures, is_completed=picked.is_held, duration=duration)
    trace = robot.witness.trace()
    return NavigationEpisode(
        arm=arm,
        terrain=terrain,
        seed=seed,
        course=built,
        outcome=robot.navigation.outcome,
        measures=measures,
        reported=reported_by(robot.guard),
        onsets=onsets(trace, hazards(trace, built, BaseParameters())),
        tree=robot.task.tree,
        events=robot.task.events,
        trace=trace,
    )


def varied(generator: np.random.Generator) -> CourseParameters:
    """The parameters of the course that differ from seed to seed."""
    return replace(
        CourseParameters(),
        bump_x=float(generator.uniform(2.3, 2.9)),
        bump_height=float(generator.uniform(0.02, 0.03)),
        friction=float(generator.uniform(0.8, 1.0)),
    )


def _assembled(
    arm: ExperimentArm,
    built: Course,
    settings: Settings,
    generators: dict[str, np.random.Generator],
    link: Link,
) -> _Robot:
    base = replace(BaseParameters(), torque=settings.usual_torque)
    physics = Base(build_navigation(built, base))
    physics.settle(_SETTLING_STEPS)

    def clock() -> int:
        return physics.now_ns

    carrier = link.carrier(clock)
    nodes: list[SimulatedNode] = [
        Imu(physics, carrier, generators["imu"], ImuParameters()),
        *base_nodes(physics, carrier, base, generators),
    ]
    guard: Guard | None = None
    operator: BaseOperator | None = None
    view: Carrier = carrier
    if arm in NAVIGATION_RULES:
        guard = link.guard(machine_of(NAVIGATION_RULES[arm]), carrier, clock)
        parameters = BaseOperatorParameters(settings.operator_delay)
        operator = BaseOperator(physics, carrier, guard, built, parameters)
        nodes += [guard, operator]
    elif arm is ExperimentArm.COLLISION_MONITOR:
        guard = BaseCollisionMonitor(carrier, clock)
        nodes.append(guard)
    if guard is not None:
        view = Remapped(carrier, {COMMAND.name: unfiltered(COMMAND.name)})
    navigation = Navigation(view, built.routes, NavigationParameters(), clock)
    witness = BaseWitness(physics, lambda: guard is not None and guard.is_restricting)
    task = SkillTask(carrier, "Fetch", "navigation.turtle", ["Target=room"])
    nodes += [task, navigation, link, witness]
    return _Robot(physics, carrier, navigation, task, guard, operator, witness, nodes)


def _drive(robot: _Robot, observers: Sequence[Observer]) -> None:
    """Run until the base has arrived or gives up."""
    looking_on = attended(observers, robot.physics, robot.carrier, robot.guard)
    run(
        robot.physics,
        [*robot.nodes, *looking_on],
        round(LONGEST_S * 1e9),
        lambda: (
            robot.navigation.outcome is TaskStatus.COMPLETED
            or robot.task.outcome is TaskStatus.GIVEN_UP
        ),
    )


def _measured(robot: _Robot, built: Course) -> NavigationMeasures:
    """The measures of the drive; nothing has been picked up yet."""
    trace, base = robot.witness.trace(), BaseParameters()
    present = hazards(trace, built, base)
    guard, operator = robot.guard, robot.operator
    return NavigationMeasures(
        is_completed=False,
        duration=robot.physics.now_ns * 1e-9,
        interventions=0 if operator is None else operator.summons.visits,
        replanned=robot.navigation.replanned,
        distance=float(trace.columns["distance"][-1]),
        peaks=peaks(trace, present["bump"]),
        time_over_torque=time_of(trace.columns["torque"] >= _NEARLY * base.torque),
        reactions=reactions(trace, present, [] if guard is None else guard.occurrences),
        time_restricted=time_of(trace.columns["is_restricted"] > 0),
        time_restricted_without_need=time_of(without_need(trace, present)),
    )
