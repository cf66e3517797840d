"""The end of experiment I: the base has arrived, and the arm picks up the block.

The base stands with its brakes on. The arm has a scene of its own, with the table at its true
position relative to the base. During the drive, the arm is only a mass on the base. Both scenes
share one time.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from heron.experiments.arm_cell import ArmCell
from heron.experiments.observer import Observer, attended
from heron.experiments.runner import SimulatedNode, Turns
from heron.guard import Guard
from heron.robot import (
    Arm,
    ArmController,
    ArmControllerParameters,
    Base,
    JointStates,
    JointStatesParameters,
)
from heron.robot.physics import attitude
from heron.scene import ArmParameters, Course, TableParameters, build_placing
from heron.scene.scene import STEP_NS
from heron.tasks import SkillTask
from heron.topics import InProcess

LONGEST_S = 20.0
_TABLE_HEIGHT = 0.65
_HOVER = 0.1  # m above the block
_LIFTED = 0.05  # m
_SEEN = 0.003  # m: how well the camera on the hand sees where the block is
_SETTLING_STEPS = 250


@dataclass(frozen=True)
class Picked:
    """The end of the picking: whether the arm has the block, and the time that this took (s)."""

    is_held: bool
    seconds: float


@dataclass(frozen=True)
class Standing:
    """A base that has arrived: its nodes, the guard among them, have their turns while the arm
    works.
    """

    base: Base
    nodes: Sequence[SimulatedNode]
    guard: Guard | None
    period_ns = STEP_NS

    @cached_property
    def _turns(self) -> Turns:
        return Turns(self.base, self.nodes)

    def tick(self, now_ns: int) -> None:  # noqa: ARG002
        """One step later."""
        self._turns.step()


def pick_up(
    standing: Standing,
    course: Course,
    task: SkillTask,
    generators: Mapping[str, np.random.Generator],
    observers: Sequence[Observer],
) -> Picked:
    """Pick up the block from the position of the base, and then do the rest of the task."""
    base, built = standing.base, ArmParameters()
    x, y = _as_seen_from(base, course.block)
    table = TableParameters(believed_height=_TABLE_HEIGHT, too_high=0.0, place=(x, y))
    block = np.array([x, y, _TABLE_HEIGHT + built.block_half])
    arm = Arm(build_placing(table, built), built, block)
    arm.settle(_SETTLING_STEPS)
    arm.began_ns = base.elapsed_ns
    carrier = InProcess()
    seen = block + generators["picking"].normal(0.0, _SEEN, 3)
    above = seen + np.array([0.0, 0.0, _HOVER])
    controller = ArmController(
        arm, carrier, {"above": above, "down": seen}, ArmControllerParameters()
    )
    joints = JointStates(arm, carrier, generators["joints"], JointStatesParameters())
    task.go_on(carrier, arm.began_ns)
    looking_on = attended(observers, arm, carrier, standing.guard)
    nodes: list[SimulatedNode] = [standing, joints, controller, task, *looking_on]
    ArmCell(arm, task, None, None, nodes).play(LONGEST_S)
    return Picked(bool(arm.block[2] > block[2] + _LIFTED), arm.now_ns * 1e-9)


def _as_seen_from(base: Base, place: tuple[float, float]) -> tuple[float, float]:
    """Transform a place on the map to the frame of the base: forward and to the left (m)."""
    yaw = attitude(base.quaternion).yaw
    x, y = place[0] - base.position[0], place[1] - base.position[1]
    cosine, sine = math.cos(yaw), math.sin(yaw)
    return float(cosine * x + sine * y), float(cosine * y - sine * x)
