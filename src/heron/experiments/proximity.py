"""The ground truth at every step of the distance between the arm and a person, and of the arm's
speed.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import mujoco
import numpy as np

from heron.experiments.trace import EpisodeTrace
from heron.experiments.visitor import Visitor
from heron.robot import Arm
from heron.scene import RoomParameters
from heron.scene.arm import JOINTS
from heron.scene.person import LEGS, PERSON
from heron.scene.scene import STEP_NS

FAR = 2.0
"""The largest measured distance (m)."""
_EVERY = 10  # steps: no distance changes by more than 4 cm meanwhile
_COLUMNS = (
    *("distance", "speed", "from_axis", "is_inside", "is_led"),
    *("x", "y", "effort", "is_restricted"),
)


class ProximityWitness:
    """Writes down every step of the arm and of the person."""

    period_ns = STEP_NS

    def __init__(
        self, arm: Arm, visitor: Visitor, room: RoomParameters, is_acting: Callable[[], bool]
    ) -> None:
        self._arm = arm
        self._visitor = visitor
        self._room = room
        self._is_acting = is_acting
        moving = arm.geoms((*JOINTS, "hand", "block"))
        self._pairs = [(a, b) for a in moving for b in arm.geoms((PERSON, *LEGS))]
        self._site = arm.model.site("grasp").id
        self._velocity = np.zeros(6)
        self._distance = FAR
        self._rows: list[tuple[float, ...]] = []

    def tick(self, now_ns: int) -> None:
        """One step later."""
        feet = self._visitor.feet
        from_axis = min(math.hypot(*foot) for foot in feet)
        if now_ns // STEP_NS % _EVERY == 0:
            self._distance = self._measured() if from_axis < 2 * FAR else FAR
        grasp = self._arm.grasp
        self._rows.append(
            (
                now_ns * 1e-9,
                self._distance,
                self._speed(),
                from_axis,
                any(self._room.is_inside(*foot) for foot in feet),
                self._visitor.is_leading,
                float(grasp[0]),
                float(grasp[1]),
                float(self._arm.efforts.max()),
                self._is_acting(),
            )
        )

    def trace(self) -> EpisodeTrace:
        """All measured values."""
        times, *columns = np.array(self._rows).T
        return EpisodeTrace(times, dict(zip(_COLUMNS, columns, strict=True)))

    def _measured(self) -> float:
        model, data = self._arm.model, self._arm.data
        found = (mujoco.mj_geomDistance(model, data, a, b, FAR, None) for a, b in self._pairs)
        return float(min(found))

    def _speed(self) -> float:
        """The speed of the grasp (m/s), the fastest point of an arm that points downwards."""
        kind = mujoco.mjtObj.mjOBJ_SITE
        model, data = self._arm.model, self._arm.data
        mujoco.mj_objectVelocity(model, data, kind, self._site, self._velocity, 0)
        return float(np.linalg.norm(self._velocity[3:]))
