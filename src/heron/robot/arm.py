"""The arm while it runs: what its servos and sensors reach of the physics."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from heron.robot.physics import Floats, Physics
from heron.scene.arm import HOME, JOINTS, LINKS, ArmParameters
from heron.scene.placing import take_up

_DAMPING = 1e-6  # of the inverse: the arm never comes near a singularity here


class Arm(Physics):
    """A scene with the arm in it."""

    def __init__(self, model: Any, parameters: ArmParameters) -> None:
        super().__init__(model)
        take_up(model, self.data, parameters)
        self._count = len(JOINTS)
        self._limits = np.array([link.torque for link in LINKS])
        self._grasp = model.site("grasp").id
        self._flange = model.site("flange").id
        self._grip = model.equality("grip").id
        self._commanded = mujoco.MjData(model)  # the kinematics of what is asked of the servos
        self._commanded.qpos[: self._count] = HOME
        mujoco.mj_kinematics(model, self._commanded)
        self._jacobian = np.zeros((6, model.nv))
        self._upright = self.data.site_xmat[self._grasp].reshape(3, 3).copy()

    @property
    def grasp(self) -> Floats:
        """Where the middle of the fingers is."""
        found: Floats = self.data.site_xpos[self._grasp]
        return found

    @property
    def commanded(self) -> Floats:
        """Where the servos were asked to have the grasp."""
        found: Floats = self._commanded.site_xpos[self._grasp].copy()
        return found

    @property
    def block(self) -> Floats:
        """Where the middle of the block is."""
        found: Floats = self.data.body("block").xpos
        return found

    @property
    def efforts(self) -> Floats:
        """The torque of each joint, as a share of what it may give."""
        found: Floats = np.abs(self.data.actuator_force[: self._count]) / self._limits
        return found

    def force(self) -> Floats:
        """What acts on the hand at its flange, in the directions of the world; weight included."""
        turned = self.data.site_xmat[self._flange].reshape(3, 3)
        found: Floats = -(turned @ self.sensor("force"))
        return found

    def move(self, place: Floats) -> None:
        """Ask the servos for the place of the grasp, with the fingers pointing down."""
        data, count = self._commanded, self._count
        mujoco.mj_kinematics(self.model, data)
        mujoco.mj_comPos(self.model, data)
        mujoco.mj_jacSite(self.model, data, self._jacobian[:3], self._jacobian[3:], self._grasp)
        turned = data.site_xmat[self._grasp].reshape(3, 3)
        skew = self._upright @ turned.T
        skew = (skew - skew.T) / 2  # of a small turn: the axis, as long as the angle
        tilt = (skew[2, 1], skew[0, 2], skew[1, 0])
        error = np.concatenate((place - data.site_xpos[self._grasp], tilt))
        jacobian = self._jacobian[:, :count]
        square = jacobian.T @ jacobian + _DAMPING * np.eye(count)
        data.qpos[:count] += np.linalg.solve(square, jacobian.T @ error)
        self.data.ctrl[:count] = data.qpos[:count]

    def let_go(self) -> None:
        """Open the fingers."""
        self.data.eq_active[self._grip] = 0
