"""The running base: the interface of its actuators and sensors to the physics."""

from __future__ import annotations

from typing import Any

from heron.robot.physics import Floats, Physics
from heron.scene.base import SIDES


class Base(Physics):
    """A scene with the base in it."""

    def __init__(self, spec: Any) -> None:
        super().__init__(spec)
        model = self.model
        wheels = tuple(f"wheel_{side}" for side in SIDES)
        self._angles = [model.joint(name).qposadr[0] for name in wheels]
        self._servos = [model.actuator(name).id for name in wheels]

    @property
    def position(self) -> Floats:
        """The position of the base."""
        found: Floats = self.data.qpos[0:3]
        return found

    @property
    def quaternion(self) -> Floats:
        """The orientation of the base: w, x, y, z."""
        found: Floats = self.data.qpos[3:7]
        return found

    @property
    def wheel_angles(self) -> tuple[float, float]:
        """The angles by which the left and the right wheel have turned (rad)."""
        left, right = (float(self.data.qpos[index]) for index in self._angles)
        return left, right

    @property
    def torque(self) -> float:
        """The torque of the servo that gives more (Nm)."""
        left, right = (abs(float(self.data.actuator_force[index])) for index in self._servos)
        return max(left, right)

    def turn_wheels(self, left: float, right: float) -> None:
        """Asks the servos for angular velocities (rad/s)."""
        self.data.ctrl[self._servos] = (left, right)

    def limit_torque(self, most: float) -> None:
        """Limit the torque that the servo of each wheel may give (Nm)."""
        self.model.actuator_forcerange[self._servos] = (-most, most)
