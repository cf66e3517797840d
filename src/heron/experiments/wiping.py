"""The stains on the board, which disappear when a sponge is pressed on them."""

from __future__ import annotations

import numpy as np

from heron.robot import Arm
from heron.scene import ArmParameters, CellParameters
from heron.scene.cell import STAIN

_TOUCH = 0.002  # m from the board
_GONE = (0.0, 0.0, -1.0)


class Stains:
    """Removes wiped stains."""

    period_ns = 20_000_000

    def __init__(self, arm: Arm, cell: CellParameters, sponge: ArmParameters) -> None:
        self._arm = arm
        self._face = cell.board_face + sponge.block_half
        self._half = sponge.block_half
        places = list(cell.stains())
        self._left = {
            int(arm.model.body(f"{STAIN}_{index}").mocapid[0]): np.array(place)
            for index, place in enumerate(places)
        }
        self._count = len(places)

    @property
    def wiped(self) -> float:
        """The share of them that is gone."""
        return 1 - len(self._left) / self._count

    def tick(self, now_ns: int) -> None:  # noqa: ARG002
        """A moment later."""
        x, y, z = self._arm.block.tolist()
        if y > self._face + _TOUCH:
            return
        for index, place in list(self._left.items()):
            if max(abs(place[0] - x), abs(place[2] - z)) < self._half:
                self._arm.data.mocap_pos[index] = _GONE
                del self._left[index]
