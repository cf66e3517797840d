"""The range scan: distances to things in all directions."""

from __future__ import annotations

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from heron import messages
from heron.robot.imperfection import Late
from heron.robot.physics import Physics
from heron.scene.ground import SEEN_GROUP
from heron.topics import SCAN, Carrier


@dataclass(frozen=True)
class RangeScanParameters:
    """Parameters of the safety laser scanners of a MiR100, whose two fields are merged into one
    full turn. Rate in Hz, times in s, lengths in m, angles in rad.
    """

    rate: float = 12.5
    latency: float = 0.1
    step: float = math.radians(0.5)
    least: float = 0.1
    most: float = 30.0
    noise: float = 0.02
    dust: float = 2e-5
    """The share of beams that something sends back that is not there."""


class RangeScan:
    """Scans from the site `scanner`, in its plane, and ignores the robot's own parts."""

    def __init__(
        self,
        physics: Physics,
        carrier: Carrier,
        generator: np.random.Generator,
        parameters: RangeScanParameters,
    ) -> None:
        self._physics = physics
        self._generator = generator
        self._parameters = parameters
        self.period_ns = round(1e9 / parameters.rate)
        self._late = Late(carrier.publisher(SCAN), round(parameters.latency * 1e9))
        self._count = round(2 * math.pi / parameters.step)
        angles = -math.pi + parameters.step * np.arange(self._count)
        self._angles = (-math.pi, float(angles[-1]), parameters.step)
        self._beams = np.stack((np.cos(angles), np.sin(angles), np.zeros(self._count)), axis=1)
        self._scanner = physics.model.site("scanner").id
        self._groups = np.zeros(6, dtype=np.uint8)
        self._groups[SEEN_GROUP] = 1
        self._met = np.zeros(self._count, dtype=np.int32)
        self._distances = np.zeros(self._count)

    def tick(self, now_ns: int) -> None:
        """One turn later."""
        reach = (self._parameters.least, self._parameters.most)
        ranges = self._ranges().astype(np.float32)
        self._late.send(now_ns, messages.laser_scan(now_ns, self._angles, reach, ranges))
        self._late.deliver(now_ns)

    def _ranges(self) -> np.ndarray:
        found, draw = self._parameters, self._generator
        true = self._true_ranges()
        seen = np.maximum(true + draw.normal(0.0, found.noise, self._count), found.least)
        is_dust = draw.random(self._count) < found.dust
        early = draw.uniform(found.least, np.clip(true, found.least, found.most))
        return np.where(is_dust, early, np.where(true > found.most, np.inf, seen))

    def _true_ranges(self) -> np.ndarray:
        data = self._physics.data
        turned = data.site_xmat[self._scanner].reshape(3, 3)
        mujoco.mj_multiRay(
            self._physics.model,
            data,
            data.site_xpos[self._scanner],
            (self._beams @ turned.T).reshape(-1),
            self._groups,
            True,
            -1,
            self._met,
            self._distances,
            None,
            self._count,
            self._parameters.most,
        )
        return np.where(self._distances < 0, np.inf, self._distances)
