"""The person of the contact experiment, who stands on the other side of the table and reaches
across.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from heron.robot import Arm
from heron.scene import CellParameters, PersonParameters
from heron.scene.cell import FOREARM, FOREARM_JOINT
from heron.scene.person import LEGS, PERSON
from heron.variants import Encounter

_FACING_THE_ARM = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))
_REACH_HEIGHT = 0.945  # m, where the hand of the robot passes
_NEAR, _AWAY = -0.36, -0.71  # the y to which the hand of the person reaches, and where it waits (m)
_DOWN = 0.82  # m; with the hand below, the robot is busy with the box
_REACHING, _DRAWING_BACK = 0.3, 1.0  # m/s
_STARTLED_NS = 400_000_000  # from being touched to drawing back
_FELT = 5.0  # N


@dataclass(frozen=True)
class Reaching:
    """A person reaches over the table at `x` (m), `further` than usual by this distance (m),
    `after` this time since the robot began to work at the box (s).
    """

    x: float = 0.0
    further: float = 0.0
    after: float = 2.0


def varied(encounter: Encounter, generator: np.random.Generator) -> Reaching | None:
    """The reach over the table that differs from seed to seed, if there is any."""
    found = Reaching(
        x=float(generator.uniform(-0.06, 0.06)),
        further=float(generator.uniform(-0.02, 0.04)),
        after=float(generator.uniform(1.0, 4.0)),
    )
    return found if encounter is Encounter.COLLISION else None


class Bystander:
    """Reaches over the table while the robot is busy, and draws back when they are touched."""

    period_ns = 10_000_000

    def __init__(
        self, arm: Arm, cell: CellParameters, person: PersonParameters, reaching: Reaching | None
    ) -> None:
        self._arm = arm
        self._reaching = reaching
        self._x = 0.0 if reaching is None else reaching.x
        self._stiffness = cell.forearm.stiffness
        self._elbow = _AWAY - cell.forearm.length
        self._out = 0.0  # m that the hand is over the table
        self._busy_ns: int | None = None
        self._touched_ns: int | None = None
        self._joint = arm.model.joint(FOREARM_JOINT).qposadr[0]
        self._forearm = arm.model.body(FOREARM).mocapid[0]
        self._stand(cell, person)
        self._move()

    @property
    def pressed(self) -> float:
        """The force with which the forearm is pressed aside (N)."""
        return abs(float(self._arm.data.qpos[self._joint])) * self._stiffness

    def tick(self, now_ns: int) -> None:
        """A moment later."""
        if self._reaching is None:
            return
        if self._busy_ns is None and self._arm.grasp[2] < _DOWN:
            self._busy_ns = now_ns
        if self._touched_ns is None and self.pressed > _FELT:
            self._touched_ns = now_ns
        step_s = self.period_ns * 1e-9
        if self._touched_ns is not None and now_ns - self._touched_ns > _STARTLED_NS:
            self._out = max(0.0, self._out - _DRAWING_BACK * step_s)
        elif self._busy_ns is not None and now_ns - self._busy_ns > self._reaching.after * 1e9:
            furthest = _NEAR - _AWAY + self._reaching.further
            self._out = min(furthest, self._out + _REACHING * step_s)
        self._move()

    def _move(self) -> None:
        self._arm.data.mocap_pos[self._forearm] = (self._x, self._elbow + self._out, _REACH_HEIGHT)

    def _stand(self, cell: CellParameters, person: PersonParameters) -> None:
        """The person reaches with the right arm."""
        model, data = self._arm.model, self._arm.data
        middle = self._x - person.shoulder_half
        places = {PERSON: (middle, 0.0)}
        for name, side in zip(LEGS, (-1, 1), strict=True):
            places[name] = (middle + side * person.hip_half, person.hip_height)
        for name, (x, z) in places.items():
            index = model.body(name).mocapid[0]
            data.mocap_pos[index] = (x, cell.person_y, z)
            data.mocap_quat[index] = _FACING_THE_ARM
