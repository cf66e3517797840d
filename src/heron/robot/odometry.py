"""Wheel odometry: the pose of the base without wheel slip, as a message and as the frame
`base_link` in `odom`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from heron import messages
from heron.robot.base import Base
from heron.robot.imperfection import Late
from heron.scene.base import BaseParameters
from heron.topics import FRAMES, ODOMETRY, Carrier


@dataclass(frozen=True)
class WheelOdometryParameters:
    """Rate in Hz, latency in s."""

    rate: float = 50.0
    latency: float = 0.02
    ticks: int = 4096
    """The encoder ticks per wheel turn."""
    radius_error: float = 0.005
    """The error of the radius that the odometry believes in, as a share: tires wear."""


class WheelOdometry:
    """Counts ticks of the wheels."""

    def __init__(
        self,
        physics: Base,
        carrier: Carrier,
        generator: np.random.Generator,
        base: BaseParameters,
        parameters: WheelOdometryParameters,
    ) -> None:
        self._physics = physics
        self._base = base
        self._parameters = parameters
        self.period_ns = round(1e9 / parameters.rate)
        latency_ns = round(parameters.latency * 1e9)
        self._late = Late(carrier.publisher(ODOMETRY), latency_ns)
        self._late_frames = Late(carrier.publisher(FRAMES), latency_ns)
        self._radius = base.wheel_radius * (1 + generator.normal(0.0, parameters.radius_error))
        self._before = self._ticks()
        self._x = self._y = self._yaw = 0.0

    def tick(self, now_ns: int) -> None:
        """One period later."""
        ticks = self._ticks()
        per_tick = 2 * math.pi * self._radius / self._parameters.ticks
        left, right = (
            (now - before) * per_tick for now, before in zip(ticks, self._before, strict=True)
        )
        self._before = ticks
        distance, turn = (left + right) / 2, (right - left) / (2 * self._base.half_track)
        self._x += distance * math.cos(self._yaw + turn / 2)
        self._y += distance * math.sin(self._yaw + turn / 2)
        self._yaw += turn
        rate = self._parameters.rate
        velocity = messages.twist(distance * rate, turn * rate)
        place = (self._x, self._y, self._yaw)
        self._late.send(now_ns, messages.odometry(now_ns, *place, velocity))
        frame = messages.transform_on_floor(now_ns, "odom", "base_link", place)
        self._late_frames.send(now_ns, frame)
        for each in (self._late_frames, self._late):
            each.deliver(now_ns)

    def _ticks(self) -> tuple[int, int]:
        per_radian = self._parameters.ticks / (2 * math.pi)
        left, right = (math.floor(angle * per_radian) for angle in self._physics.wheel_angles)
        return left, right
