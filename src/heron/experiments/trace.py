"""The ground truth of an episode at every step, which no sensor reports."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from heron.robot import Arm, Base
from heron.robot.imperfection import LowPass
from heron.robot.physics import Floats, attitude
from heron.scene.base import AXLES, SIDES
from heron.scene.scene import STEP_NS

_BANDWIDTH = 40.0  # Hz
_COLUMNS = ("x", "y", "pitch", "torque", "is_restricted")


@dataclass(frozen=True)
class EpisodeTrace:
    """One row for each step: instants (s), columns, and of the base the acceleration of each axle
    (m/s^2).
    """

    times: Floats
    columns: dict[str, Floats]
    accelerations: dict[str, Floats] = field(default_factory=dict)


class BaseWitness:
    """Writes down every step of the base."""

    period_ns = STEP_NS

    def __init__(self, physics: Base, is_restricting: Callable[[], bool]) -> None:
        self._physics = physics
        self._is_restricting = is_restricting
        self._rows: list[tuple[float, ...]] = []
        self._axles: list[Floats] = []
        names = [f"{axle}_{side}" for axle in AXLES for side in SIDES]
        self._sensors = [physics.sensor(name) for name in names]

    def tick(self, now_ns: int) -> None:
        """One step later."""
        physics = self._physics
        x, y, _ = physics.position.tolist()
        pitch = attitude(physics.quaternion).pitch
        is_restricted = float(self._is_restricting())
        self._rows.append((now_ns * 1e-9, x, y, pitch, physics.torque, is_restricted))
        self._axles.append(np.concatenate(self._sensors))

    def trace(self) -> EpisodeTrace:
        """All recorded rows."""
        rows = np.array(self._rows)
        axles = np.array(self._axles).reshape(len(rows), len(AXLES), len(SIDES), 3)
        columns = {name: rows[:, index + 1] for index, name in enumerate(_COLUMNS)}
        columns["distance"] = _travelled(rows[:, 0], columns["x"], columns["y"])
        return EpisodeTrace(
            rows[:, 0], columns, {name: axles[:, index] for index, name in enumerate(AXLES)}
        )


def _travelled(times: Floats, x: Floats, y: Floats) -> Floats:
    """The distance travelled, forward and backward (m). It adds the distances between positions at
    intervals of 0.1 s, so trembling on the spot does not count.
    """
    stride = round(0.1e9 / STEP_NS)
    places = np.unique(np.append(np.arange(0, len(times), stride), len(times) - 1))
    steps = np.hypot(np.diff(x[places]), np.diff(y[places]))
    found: Floats = np.interp(times, times[places], np.concatenate(([0.0], np.cumsum(steps))))
    return found


class ArmWitness:
    """Writes down every step of the arm: forces as its sensor has them, without noise."""

    period_ns = STEP_NS

    def __init__(self, arm: Arm, is_acting: Callable[[], bool]) -> None:
        self._arm = arm
        self._is_acting = is_acting
        self._weight = arm.force()
        self._low_pass = LowPass(_BANDWIDTH, STEP_NS)
        self._rows: list[tuple[float, ...]] = []

    def tick(self, now_ns: int) -> None:
        """One step later."""
        force = self._low_pass.feed(self._arm.force() - self._weight)
        effort = float(self._arm.efforts.max())
        height = float(self._arm.grasp[2])
        self._rows.append((now_ns * 1e-9, float(force[2]), effort, height, self._is_acting()))

    def trace(self) -> EpisodeTrace:
        """All recorded values."""
        times, force, effort, height, is_acting = np.array(self._rows).T
        columns = {"force": force, "effort": effort, "height": height, "is_restricted": is_acting}
        return EpisodeTrace(times, columns)
