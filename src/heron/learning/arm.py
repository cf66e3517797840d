"""The arm that holds the peg: it follows velocities with a compliant hand, and pushes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from heron.scene.insertion import (
    FRAGILE_TOUCH,
    STEP_NS,
    WRIST_FORCE,
    InsertionParameters,
    Vector,
    build_insertion,
)

Floats = NDArray[np.float64]
_GRAVITY = 9.81
STEPS = 2
"""Steps of the physics between two readings of the sensors, at 125 Hz."""
READING_NS = STEPS * STEP_NS
_READING_S = READING_NS * 1e-9
REACH = 0.06
"""The furthest that the wanted place may be from the hand, along each axis (m)."""


@dataclass(frozen=True)
class ArmCommand:
    """A velocity (m/s) in the frame of the scene, and a force along z (N): 0 or downwards. While it
    pushes, the hand is free along z and heeds no velocity there.
    """

    velocity: Vector
    push: float


class PegArm:
    """The physics of the scene."""

    def __init__(self, scene: InsertionParameters) -> None:
        self.scene = scene
        self.model = model = build_insertion(scene).compile()
        self.data = mujoco.MjData(model)
        self._spring_z = model.actuator("z").id
        self._stiff = [float(each) for each in model.actuator_gainprm[self._spring_z]]
        self._stiff_bias = [float(each) for each in model.actuator_biasprm[self._spring_z]]
        self._wanted = [0.0, 0.0, 0.0]
        self._is_pushing = False
        self._wrist = _readings(model, WRIST_FORCE)
        self._touch = _readings(model, FRAGILE_TOUCH)
        self._weight = np.array([0.0, 0.0, scene.peg_mass * _GRAVITY])

    def put(self, place: Vector) -> None:
        """Begin at rest, with the middle of the lower end of the peg at a place."""
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:3] = place
        self._wanted = list(place)
        self._free_along_z(False)
        self.data.ctrl[:3] = place
        mujoco.mj_forward(self.model, self.data)

    @property
    def place(self) -> Floats:
        """The middle of the lower end of the peg (m)."""
        found: Floats = self.data.qpos[:3].copy()
        return found

    @property
    def velocity(self) -> Floats:
        """Its velocity (m/s)."""
        found: Floats = self.data.qvel[:3].copy()
        return found

    @property
    def force(self) -> Floats:
        """The force on the peg that the wrist feels (N), without the weight of the peg."""
        found: Floats = self._weight - self.data.sensordata[self._wrist]
        return found

    @property
    def touch(self) -> float:
        """The force on the fragile part (N)."""
        return float(self.data.sensordata[self._touch][0])

    def follow(self, command: ArmCommand) -> None:
        """Execute a command until the next reading of the sensors."""
        if self._is_pushing != (command.push < 0.0):
            self._free_along_z(not self._is_pushing)
        place = self.data.qpos.tolist()
        for axis, speed in enumerate(command.velocity):
            wanted = self._wanted[axis] + speed * _READING_S
            self._wanted[axis] = min(max(wanted, place[axis] - REACH), place[axis] + REACH)
        if self._is_pushing:
            self._wanted[2] = place[2]
        self.data.ctrl[:] = (*self._wanted, min(0.0, command.push))
        mujoco.mj_step(self.model, self.data, nstep=STEPS)

    def _free_along_z(self, is_free: bool) -> None:
        """Make the hand free along z, with damping only, or compliant as in the plane."""
        model, number = self.model, self._spring_z
        self._is_pushing = is_free
        model.actuator_gainprm[number] = np.zeros(len(self._stiff)) if is_free else self._stiff
        model.actuator_biasprm[number] = self._stiff_bias
        if is_free:
            model.actuator_biasprm[number][1:3] = (0.0, -self.scene.push_damping)


def _readings(model: Any, name: str) -> slice:
    sensor = model.sensor(name)
    return slice(sensor.adr[0], sensor.adr[0] + sensor.dim[0])
