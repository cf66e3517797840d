"""The pose of the base on the map, as estimated from laser scans by a particle filter.

The scans are not simulated here: the estimate is the true pose with typical errors.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from heron import messages
from heron.robot.base import Base
from heron.robot.imperfection import Drift, Late
from heron.robot.physics import attitude
from heron.topics import POSE, Carrier


@dataclass(frozen=True)
class LocalizationParameters:
    """Rate in Hz, times in s, lengths in m, angles in rad."""

    rate: float = 10.0
    latency: float = 0.1
    position_error: float = 0.02
    yaw_error: float = math.radians(0.5)
    error_time: float = 2.0
    """The time for which errors stay alike."""


class Localization:
    """Says where the base was a moment ago."""

    def __init__(
        self,
        physics: Base,
        carrier: Carrier,
        generator: np.random.Generator,
        parameters: LocalizationParameters,
    ) -> None:
        self._physics = physics
        self._step_s = 1 / parameters.rate
        self.period_ns = round(1e9 / parameters.rate)
        self._late = Late(carrier.publisher(POSE), round(parameters.latency * 1e9))
        time_constant = parameters.error_time
        self._position = Drift(generator, parameters.position_error, time_constant, 2)
        self._yaw = Drift(generator, parameters.yaw_error, time_constant, 1)

    def tick(self, now_ns: int) -> None:
        """One period later."""
        x, y = (self._physics.position[:2] + self._position.after(self._step_s)).tolist()
        yaw = attitude(self._physics.quaternion).yaw + float(self._yaw.after(self._step_s)[0])
        self._late.send(now_ns, messages.stamped_pose(now_ns, x, y, yaw))
        self._late.deliver(now_ns)
