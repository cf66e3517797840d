"""The ground truth of contact at every step: forces, the position of the box, and the pressed
person.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from heron.experiments.bystander import Bystander
from heron.experiments.trace import EpisodeTrace
from heron.experiments.wiping import Stains
from heron.robot import Arm
from heron.robot.imperfection import LowPass
from heron.scene import CellParameters
from heron.scene.cell import BOX
from heron.scene.scene import STEP_NS

_BANDWIDTH = 40.0  # Hz
_TOUCH = 0.001  # m
_COLUMNS = ("force", "pressed", "is_jammed", "pushed", "wiped", "is_restricted")


class ContactWitness:
    """Writes down every step. `force` is that on the hand, as its sensor has it, without noise and
    weight; `pressed` that on the forearm of the person (N); `pushed` how far the box was (m).
    """

    period_ns = STEP_NS

    def __init__(
        self,
        arm: Arm,
        cell: CellParameters,
        bystander: Bystander,
        stains: Stains,
        is_acting: Callable[[], bool],
    ) -> None:
        self._arm = arm
        self._cell = cell
        self._bystander = bystander
        self._stains = stains
        self._is_acting = is_acting
        self._weight = arm.force()
        self._low_pass = LowPass(_BANDWIDTH, STEP_NS)
        self._rows: list[tuple[float, ...]] = []

    @property
    def box(self) -> tuple[float, float]:
        """The place of the middle of the box on the table (m)."""
        x, y, _ = self._arm.data.body(BOX).xpos.tolist()
        return x, y

    def tick(self, now_ns: int) -> None:
        """One step later."""
        force = self._low_pass.feed(self._arm.force() - self._weight)
        pushed = self._cell.box_place[1] - self.box[1]
        jam = self._cell.jam
        self._rows.append(
            (
                now_ns * 1e-9,
                float(np.linalg.norm(force)),
                self._bystander.pressed,
                jam is not None and pushed > jam - _TOUCH,
                pushed,
                self._stains.wiped,
                self._is_acting(),
            )
        )

    def trace(self) -> EpisodeTrace:
        """All measured values."""
        times, *columns = np.array(self._rows).T
        return EpisodeTrace(times, dict(zip(_COLUMNS, columns, strict=True)))
