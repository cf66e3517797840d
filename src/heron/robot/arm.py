"""The running arm: the interface of its servos and sensors to the physics."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from heron.robot.physics import Floats, Physics
from heron.scene.arm import GRIP, HOME, JOINTS, LINKS, ArmParameters
from heron.scene.placing import lay_down, take_up

_DAMPING = 1e-6  # of the inverse: the arm never comes near a singularity here
_MOST_TURN = 0.004  # rad at each call: a hand that was turned aside is not flung back
_LOOSE_DAMPING = (20.0, 20.0, 20.0, 2.0, 2.0, 2.0)  # Nm s/rad, so that nothing swings on
_FINGERS = 0.015  # m: how far from the middle of the fingers the block may be
_GRAVITY = 9.81


class Arm(Physics):
    """A scene with the arm in it. The block is in its hand, or, where `block` says so, somewhere
    else.
    """

    def __init__(self, spec: Any, parameters: ArmParameters, block: Floats | None = None) -> None:
        super().__init__(spec)
        model = self.model
        if block is None:
            take_up(model, self.data, parameters)
        else:
            lay_down(model, self.data, block)
        self._count = len(JOINTS)
        self._payload = parameters.block_mass
        self._limits = np.array([link.torque for link in LINKS])
        self._servos = model.actuator_gainprm[: self._count].copy()
        self._feedback = model.actuator_biasprm[: self._count].copy()
        self._is_loose = False
        self._strides = 0
        self._stride = np.zeros(self._count)
        self._grasp = model.site("grasp").id
        self._flange = model.site("flange").id
        self._grip = model.equality(GRIP).id
        self._commanded = mujoco.MjData(model)  # the kinematics of the commands to the servos
        self._commanded.qpos[: self._count] = HOME
        mujoco.mj_kinematics(model, self._commanded)
        self._jacobian = np.zeros((6, model.nv))
        self._upright = self.data.site_xmat[self._grasp].reshape(3, 3).copy()

    @property
    def grasp(self) -> Floats:
        """The point between the fingers."""
        found: Floats = self.data.site_xpos[self._grasp]
        return found

    @property
    def commanded(self) -> Floats:
        """The grasp position that the servos are commanded to."""
        found: Floats = self._commanded.site_xpos[self._grasp].copy()
        return found

    @property
    def block(self) -> Floats:
        """The centre of the block."""
        found: Floats = self.data.body("block").xpos
        return found

    @property
    def angles(self) -> Floats:
        """The joint angles (rad)."""
        found: Floats = self.data.qpos[: self._count].copy()
        return found

    @property
    def speeds(self) -> Floats:
        """The joint velocities (rad/s)."""
        found: Floats = self.data.qvel[: self._count].copy()
        return found

    @property
    def torques(self) -> Floats:
        """The joint torques (Nm)."""
        found: Floats = self.data.actuator_force[: self._count].copy()
        return found

    @property
    def efforts(self) -> Floats:
        """The torque of each joint, as a share of its maximum."""
        found: Floats = np.abs(self.torques) / self._limits
        return found

    def force(self) -> Floats:
        """The force on the hand at its flange, in the directions of the world; weight included."""
        turned = self.data.site_xmat[self._flange].reshape(3, 3)
        found: Floats = -(turned @ self.sensor("force"))
        return found

    def move(self, place: Floats, steps: int = 1) -> None:
        """Command the servos to a position of the grasp, with the fingers pointing down: at once,
        or in equal parts over `glide`.
        """
        if self._is_loose:
            self._tighten()
        data, count = self._commanded, self._count
        mujoco.mj_kinematics(self.model, data)
        mujoco.mj_comPos(self.model, data)
        mujoco.mj_jacSite(self.model, data, self._jacobian[:3], self._jacobian[3:], self._grasp)
        turned = data.site_xmat[self._grasp].reshape(3, 3)
        skew = self._upright @ turned.T
        skew = (skew - skew.T) / 2  # of a small turn: the axis, as long as the angle
        tilt = np.array((skew[2, 1], skew[0, 2], skew[1, 0]))
        tilt *= min(1.0, _MOST_TURN / max(float(np.linalg.norm(tilt)), _MOST_TURN))
        error = np.concatenate((place - data.site_xpos[self._grasp], tilt))
        jacobian = self._jacobian[:, :count]
        square = jacobian.T @ jacobian + _DAMPING * np.eye(count)
        data.qpos[:count] += np.linalg.solve(square, jacobian.T @ error)
        self._stride = (data.qpos[:count] - self.data.ctrl[:count]) / steps
        self._strides = steps
        self.glide()

    def glide(self) -> None:
        """The next part of a move, if there is one left."""
        if self._strides:
            self._strides -= 1
            self.data.ctrl[: self._count] += self._stride

    def loosen(self) -> None:
        """Compensate gravity: the servos only carry the weight, and yield to a person who moves the
        arm. Call this in each step in which the arm must yield.
        """
        model, count = self.model, self._count
        if not self._is_loose:
            self._is_loose = True
            model.actuator_gainprm[:count] = 0.0
            model.actuator_biasprm[:count] = 0.0
            model.actuator_biasprm[:count, 2] = -np.array(_LOOSE_DAMPING)
        held = self._payload * _GRAVITY * float(self.data.eq_active[self._grip])
        mujoco.mj_jacSite(model, self.data, self._jacobian[:3], self._jacobian[3:], self._grasp)
        self.data.qfrc_applied[:count] = held * self._jacobian[2, :count]

    def _tighten(self) -> None:
        """The servos hold the joints where they are."""
        model, count = self.model, self._count
        self._is_loose = False
        model.actuator_gainprm[:count] = self._servos
        model.actuator_biasprm[:count] = self._feedback
        self.data.qfrc_applied[:count] = 0.0
        self.data.ctrl[:count] = self._commanded.qpos[:count] = self.angles
        mujoco.mj_kinematics(model, self._commanded)

    def take_hold(self) -> bool:
        """Close the fingers; whether the block is between them."""
        if float(np.linalg.norm(self.block - self.grasp)) > _FINGERS:
            return False
        self.data.eq_active[self._grip] = 1
        return True

    def let_go(self) -> None:
        """Open the fingers."""
        self.data.eq_active[self._grip] = 0
