"""The view of the task. This module changes no computation of an environment."""

from __future__ import annotations

import numpy as np

from heron.appearance import Camera, Canvas, Pixels, Size, Stage, VisibleState
from heron.learning.insertion import Insertion
from heron.scene.insertion import build_insertion
from heron.scene.person import STRIDE, stance

CAMERA = Camera("table", distance=2.4, azimuth=102.0, elevation=-25.0, above=0.6)
_LARGEST_STRIDE = 2 * STRIDE  # m; a person who stands next to the cell has closed legs


def moment(insertion: Insertion) -> VisibleState:
    """The visible scene, with the person, who is not part of the physics."""
    data, scene = insertion.arm.data, insertion.task.scene
    place, facing, share = insertion.person
    limbs, _ = stance(scene.person, place, facing, share * _LARGEST_STRIDE)
    return VisibleState(
        data.qpos.copy(),
        np.array([limb.place for limb in limbs]),
        np.array([limb.turn for limb in limbs]),
        data.eq_active.copy(),
    )


class Look:
    """Pictures of a task. Close it after use."""

    def __init__(self, insertion: Insertion, size: Size) -> None:
        """Raises `CannotDrawError`."""
        self._insertion = insertion
        self._stage = Stage(build_insertion(insertion.task.scene))
        self._canvas = Canvas(self._stage, CAMERA, size)

    def picture(self) -> Pixels:
        """A picture of the present state, of shape (height, width, 3)."""
        self._stage.show(moment(self._insertion))
        return self._canvas.draw()

    def close(self) -> None:
        """Release the resources for drawing."""
        self._canvas.close()
