"""The child of experiment V, who waits behind a door until the base has come near."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from heron.robot import Base
from heron.scene import CorridorParameters, PersonParameters
from heron.scene.person import LEGS, PERSON, stance
from heron.variants import Passage

Point = tuple[float, float]


@dataclass(frozen=True)
class Dash:
    """A child runs out of a door when the front of the base is `gap` m away, with `pace` m/s. The
    child stays in the path of the base for `stay_s`, and goes back.
    """

    gap: float
    pace: float
    stay_s: float
    away: float = 0.25
    """The position behind the inner side of the wall, where the child waits (m)."""


def varied(passage: Passage, generator: np.random.Generator) -> Dash | None:
    """The part that differs from seed to seed; None where there is no child."""
    gap = float(generator.uniform(0.5, 3.5))
    pace = float(generator.uniform(1.0, 1.4))
    stay_s = float(generator.uniform(2.0, 4.0))
    return Dash(gap, pace, stay_s) if passage is Passage.CHILD else None


class WalkingChild:
    """Waits, runs, stands and goes back."""

    period_ns = 20_000_000

    def __init__(
        self,
        physics: Base,
        corridor: CorridorParameters,
        person: PersonParameters,
        dash: Dash | None,
        front: Callable[[], float],
    ) -> None:
        """`front` returns the position of the front of the base along the corridor (m)."""
        self._physics = physics
        self._corridor = corridor
        self._person = person
        self._dash = dash
        self._front = front
        self._limbs = [physics.model.body(name).mocapid[0] for name in (PERSON, *LEGS)]
        self._begun_s: float | None = None
        self.place: Point = (0.0, 0.0)
        self.tick(0)

    @property
    def is_in_corridor(self) -> bool:
        """The child has left the door."""
        return abs(self.place[1]) < self._corridor.half_width

    def tick(self, now_ns: int) -> None:
        """A moment later."""
        door, now_s = self._corridor.door_x, now_ns * 1e-9
        dash = self._dash
        if dash is None:
            self._stand((door, 10.0), 0.0, -1)
            return
        if self._begun_s is None and self._front() >= door - dash.gap:
            self._begun_s = now_s
        start = self._corridor.half_width + dash.away
        since_s = 0.0 if self._begun_s is None else now_s - self._begun_s
        there_s = start / dash.pace
        back = max(0.0, since_s - there_s - dash.stay_s) * dash.pace
        walked = min(start, since_s * dash.pace)
        self._stand((door, start - walked + min(start, back)), walked + back, 1 if back else -1)

    def _stand(self, place: Point, walked: float, direction: int) -> None:
        self.place = place
        limbs, _ = stance(self._person, place, direction * math.pi / 2, walked)
        data = self._physics.data
        for index, limb in zip(self._limbs, limbs, strict=True):
            data.mocap_pos[index], data.mocap_quat[index] = limb
