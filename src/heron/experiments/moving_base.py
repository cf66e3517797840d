"""A base that moves among obstacles: its sensors, its drive, and its distance to the obstacles."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import mujoco
import numpy as np

from heron.experiments.episode import acting
from heron.experiments.runner import SimulatedNode
from heron.experiments.trace import EpisodeTrace
from heron.guard import InProcessGuard
from heron.robot import (
    Base,
    DifferentialDrive,
    DriveParameters,
    Localization,
    LocalizationParameters,
    RangeScan,
    RangeScanParameters,
    WheelOdometry,
    WheelOdometryParameters,
)
from heron.scene import BaseParameters
from heron.scene.scene import STEP_NS
from heron.topics import Carrier

SEEDED = ("odometry", "localization", "scan")
"""The names of the generators that the nodes of the base need."""
FAR = 2.0
"""The largest measured distance (m)."""
_EVERY = 5  # steps: no distance changes by more than 3 cm meanwhile


def base_nodes(
    physics: Base,
    carrier: Carrier,
    base: BaseParameters,
    generators: Mapping[str, np.random.Generator],
) -> list[SimulatedNode]:
    """The sensors of a base, and its drive."""
    return [
        WheelOdometry(physics, carrier, generators["odometry"], base, WheelOdometryParameters()),
        Localization(physics, carrier, generators["localization"], LocalizationParameters()),
        RangeScan(physics, carrier, generators["scan"], RangeScanParameters()),
        DifferentialDrive(physics, carrier, base, DriveParameters()),
    ]


class NearnessWitness:
    """Writes down every step of the base: where it is, how fast (m/s), its distance to the nearest
    of some geoms (m, up to `FAR`), and whether a guard acts.
    """

    period_ns = STEP_NS

    def __init__(
        self,
        physics: Base,
        geoms: Iterable[int],
        guard: InProcessGuard | None,
        hazard: tuple[str, Callable[[], bool]],
        is_worth_measuring: Callable[[], bool] = lambda: True,
    ) -> None:
        """`hazard` is a column that is true during the hazard."""
        self._physics = physics
        self._is_acting = acting(guard)
        self._name, self._is_there = hazard
        self._is_worth_measuring = is_worth_measuring
        chassis = physics.model.geom("chassis").id
        self._pairs = [(chassis, geom) for geom in geoms]
        self._distance = FAR
        self._rows: list[tuple[float, ...]] = []

    def tick(self, now_ns: int) -> None:
        """One step later."""
        x, y, _ = self._physics.position.tolist()
        if now_ns // STEP_NS % _EVERY == 0:
            self._distance = self._measured() if self._is_worth_measuring() else FAR
        speed = float(np.linalg.norm(self._physics.data.qvel[:2]))
        is_there, is_acting = self._is_there(), self._is_acting()
        self._rows.append((now_ns * 1e-9, x, y, speed, self._distance, is_there, is_acting))

    def trace(self) -> EpisodeTrace:
        """All measured values."""
        names = ("x", "y", "speed", "distance", self._name, "is_restricted")
        times, *columns = np.array(self._rows).T
        return EpisodeTrace(times, dict(zip(names, columns, strict=True)))

    def _measured(self) -> float:
        model, data = self._physics.model, self._physics.data
        found = (mujoco.mj_geomDistance(model, data, a, b, FAR, None) for a, b in self._pairs)
        return float(min(found))
