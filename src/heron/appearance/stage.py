"""A dressed scene that shows the states of the plain one."""

from __future__ import annotations

from typing import Any, NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from heron.appearance.dressing import dressed
from heron.appearance.holder import Holder, holder_of
from heron.appearance.robot import FINGERS
from heron.scene.arm import GRIP

Floats = NDArray[np.float64]
_OPEN = 0.02  # m that each finger goes aside
_LAMP_AWAY = 5.0  # m


class VisibleState(NamedTuple):
    """The visible part of a state: joints, moved bodies, and the thing in the hand."""

    joints: Floats
    places: Floats
    turns: Floats
    holds: NDArray[np.uint8]


def moment_of(data: Any) -> VisibleState:
    """The present state of a scene."""
    return VisibleState(
        data.qpos.copy(), data.mocap_pos.copy(), data.mocap_quat.copy(), data.eq_active.copy()
    )


class Stage:
    """A scene for drawing, with `model` and `data` of MuJoCo."""

    def __init__(self, spec: Any) -> None:
        self.model = dressed(spec)
        self.data = mujoco.MjData(self.model)
        names = [self.model.geom(index).name for index in range(self.model.ngeom)]
        self._fingers = [names.index(name) for name in FINGERS if name in names]
        self._closed = self.model.geom_pos[self._fingers].copy()
        self._holder: Holder | None = holder_of(self.model)

    def show(self, moment: VisibleState) -> None:
        """Take this state."""
        model, data = self.model, self.data
        data.qpos[:], data.eq_active[:] = moment.joints, moment.holds
        data.mocap_pos[:], data.mocap_quat[:] = moment.places, moment.turns
        self._move_fingers()
        if self._holder is not None:
            self._holder.hold(model, data.qpos[:3])
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_camlight(model, data)

    def places(self) -> Floats:
        """The places of all parts (m), of shape (parts, 3)."""
        found: Floats = self.data.geom_xpos.copy()
        return found

    def place_of(self, name: str) -> Floats:
        """The place of a body, or of a part of one (m)."""
        model, data = self.model, self.data
        if mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name) >= 0:
            found: Floats = data.body(name).xpos
        else:
            found = data.geom(name).xpos
        return found

    def light(self, place: Floats) -> None:
        """Throw shadows around a place (m)."""
        self.model.light_pos[0] = place - _LAMP_AWAY * self.model.light_dir[0]
        mujoco.mj_camlight(self.model, self.data)

    def _move_fingers(self) -> None:
        """Close them while the hand holds the block."""
        for index, place, side in zip(self._fingers, self._closed, (-1, 1), strict=False):
            is_open = not self.data.eq_active[self.model.equality(GRIP).id]
            self.model.geom_pos[index] = place + np.array([side * _OPEN * is_open, 0.0, 0.0])
