"""The end of experiment I: the base has arrived, and the arm picks up the block.

The base stands, with its brakes on, so the arm has a scene of its own, with the table where it
really is from there. On the way the arm is but a mass on the base.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from heron.experiments.arm_cell import ArmCell
from heron.robot import Arm, ArmController, ArmControllerParameters, Base
from heron.robot.physics import attitude
from heron.scene import ArmParameters, Course, TableParameters, build_placing
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
    """Whether the arm has the block in the end, and how long that took (s)."""

    is_held: bool
    seconds: float


def pick_up(base: Base, course: Course, task: SkillTask, generator: np.random.Generator) -> Picked:
    """From where the base stands, as the rest of the task."""
    built = ArmParameters()
    x, y = _as_seen_from(base, course.block)
    table = TableParameters(believed_height=_TABLE_HEIGHT, too_high=0.0, place=(x, y))
    block = np.array([x, y, _TABLE_HEIGHT + built.block_half])
    arm = Arm(build_placing(table, built), built, block)
    arm.settle(_SETTLING_STEPS)
    carrier = InProcess()
    seen = block + generator.normal(0.0, _SEEN, 3)
    above = seen + np.array([0.0, 0.0, _HOVER])
    controller = ArmController(
        arm, carrier, {"above": above, "down": seen}, ArmControllerParameters()
    )
    task.go_on(carrier)
    ArmCell(arm, task, None, None, [controller, task]).play(LONGEST_S)
    return Picked(bool(arm.block[2] > block[2] + _LIFTED), arm.now_ns * 1e-9)


def _as_seen_from(base: Base, place: tuple[float, float]) -> tuple[float, float]:
    """Where a place on the map is from the base: forward and to the left."""
    yaw = attitude(base.quaternion).yaw
    x, y = place[0] - base.position[0], place[1] - base.position[1]
    cosine, sine = math.cos(yaw), math.sin(yaw)
    return float(cosine * x + sine * y), float(cosine * y - sine * x)
