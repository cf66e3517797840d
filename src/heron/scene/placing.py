"""The scene of the placing experiment: the arm above a table, which may be higher than expected."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from heron.scene.arm import GRIP, HOME, ArmParameters, add_arm
from heron.scene.ground import Contact
from heron.scene.scene import new_spec

_HALF = (0.3, 0.3, 0.02)


@dataclass(frozen=True)
class TableParameters:
    """Lengths in m. `believed_height` is the height of the table that the arm assumes."""

    believed_height: float = 0.75
    too_high: float = 0.04
    friction: float = 0.8
    place: tuple[float, float] = (0.134, -0.492)

    @property
    def height(self) -> float:
        """The true height of the top."""
        return self.believed_height + self.too_high


def build_placing(table: TableParameters, arm: ArmParameters) -> Any:
    """The arm at its home pose, the block in its hand."""
    spec = new_spec()
    add_arm(spec, arm)
    contact = Contact(table.friction, arm.contact_time)
    top = add_table(spec, table.place, table.height, _HALF, contact)
    top.name = "table"
    return spec


def add_table(
    spec: Any,
    place: tuple[float, float],
    height: float,
    half: tuple[float, float, float],
    contact: Contact,
) -> Any:
    """The top of a table, at its height."""
    top = spec.worldbody.add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX, size=half, pos=[*place, height - half[2]]
    )
    top.rgba = [0.8, 0.7, 0.55, 1]
    contact.apply(top)
    return top


def lay_down(model: Any, data: Any, place: NDArray[np.float64]) -> None:
    """An initial state: the arm at home with open fingers, the middle of the block at a place."""
    _go_home(model, data)
    data.eq_active[model.equality(GRIP).id] = 0
    address = model.joint("block").qposadr[0]
    data.qpos[address : address + 3] = place
    mujoco.mj_forward(model, data)


def take_up(model: Any, data: Any, arm: ArmParameters) -> None:
    """An initial state: the arm at home, the block in its hand."""
    _go_home(model, data)
    hand = data.body("hand")
    reach = np.array([0.0, arm.hand_length + arm.block_half, 0.0])
    address = model.joint("block").qposadr[0]
    data.qpos[address : address + 3] = hand.xpos + hand.xmat.reshape(3, 3) @ reach
    data.qpos[address + 3 : address + 7] = hand.xquat
    mujoco.mj_forward(model, data)


def _go_home(model: Any, data: Any) -> None:
    data.qpos[: len(HOME)] = HOME
    data.ctrl[: len(HOME)] = HOME
    mujoco.mj_kinematics(model, data)
