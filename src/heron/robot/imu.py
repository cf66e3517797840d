"""The inertial measurement unit: acceleration, angular velocity, and orientation of the base."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from heron import messages
from heron.robot.base import Base
from heron.robot.imperfection import Drift, Late, LowPass
from heron.robot.physics import attitude
from heron.scene.scene import STEP_NS
from heron.topics import IMU, Carrier


@dataclass(frozen=True)
class ImuParameters:
    """Parameters of a unit with consumer MEMS sensors and its own attitude filter, as is usual on
    mobile bases. Frequencies in Hz, times in s, accelerations in m/s^2, angles in rad.
    """

    rate: float = 100.0
    latency: float = 0.01
    bandwidth: float = 20.0
    """The low-pass of the unit, which can be set. Wide open, each joint of the floor is a jolt."""
    acceleration_noise: float = 0.05
    acceleration_bias: float = 0.05
    gyro_noise: float = 0.005
    tilt_noise: float = math.radians(0.05)
    tilt_drift: float = math.radians(0.4)
    tilt_drift_time: float = 5.0


class Imu:
    """Sees every step of the physics, because it filters; speaks at its own rate."""

    period_ns = STEP_NS

    def __init__(
        self,
        physics: Base,
        carrier: Carrier,
        generator: np.random.Generator,
        parameters: ImuParameters,
    ) -> None:
        self._physics = physics
        self._generator = generator
        self._parameters = parameters
        self._late = Late(carrier.publisher(IMU), round(parameters.latency * 1e9))
        self._low_pass = LowPass(parameters.bandwidth, STEP_NS)
        self._bias = generator.normal(0.0, parameters.acceleration_bias, 3)
        self._drift = Drift(generator, parameters.tilt_drift, parameters.tilt_drift_time, 2)
        self._steps = round(1e9 / parameters.rate / STEP_NS)
        self._acceleration = physics.sensor("acceleration")
        self._gyro = physics.sensor("gyro")

    def tick(self, now_ns: int) -> None:
        """One step later."""
        seen = self._low_pass.feed(np.concatenate((self._acceleration, self._gyro)))
        if now_ns // STEP_NS % self._steps == 0:
            self._late.send(now_ns, self._reading(now_ns, seen))
        self._late.deliver(now_ns)

    def _reading(self, now_ns: int, seen: np.ndarray) -> messages.Message:
        found, draw = self._parameters, self._generator.normal
        acceleration = seen[:3] + self._bias + draw(0.0, found.acceleration_noise, 3)
        rates = seen[3:] + draw(0.0, found.gyro_noise, 3)
        true = attitude(self._physics.quaternion)
        error = self._drift.after(1 / found.rate) + draw(0.0, found.tilt_noise, 2)
        orientation = quaternion(true.roll + error[0], true.pitch + error[1], true.yaw)
        return messages.imu(
            now_ns, orientation, tuple(rates.tolist()), tuple(acceleration.tolist())
        )


def quaternion(roll: float, pitch: float, yaw: float) -> messages.Message:
    """An orientation from its angles (rad): yaw first, then pitch, then roll."""
    (sr, cr), (sp, cp), (sy, cy) = (
        (math.sin(angle / 2), math.cos(angle / 2)) for angle in (roll, pitch, yaw)
    )
    return messages.Quaternion(
        x=sr * cp * cy - cr * sp * sy,
        y=cr * sp * cy + sr * cp * sy,
        z=cr * cp * sy - sr * sp * cy,
        w=cr * cp * cy + sr * sp * sy,
    )
