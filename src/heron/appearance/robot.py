"""The appearance of the robot: a flat base on wheels with a lamp all around, and an arm of tubes.

Its design copies no product; only the dimensions are those of a MiR100 and a UR5e.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from heron.appearance.materials import (
    BLOCK,
    CAP,
    DARK,
    JOINT,
    LAMP,
    RUBBER,
    SHELL,
    STEEL,
    add_materials,
)
from heron.appearance.shapes import (
    SHOWN_GROUP,
    Section,
    add_box,
    add_limb,
    add_loft,
    add_rod,
    hide,
    paint,
)
from heron.scene import ArmParameters, BaseParameters
from heron.scene.arm import JOINTS, add_arm
from heron.scene.base import AXLES, SIDES
from heron.scene.scene import new_spec

FINGERS = ("left_finger", "right_finger")
_DRIVING = (-1.57, -2.6, 2.5, -1.47, -1.57, 0.0)  # the arm folded above the base
_TUBES = {  # from, to, radius and material, in the frame of each link
    "shoulder": (
        ((0, 0, -0.07), (0, 0, 0.06), 0.062, JOINT),
        ((0, 0, 0.06), (0, 0, 0.072), 0.055, CAP),
        ((0, 0, 0), (0, 0.07, 0), 0.056, JOINT),
    ),
    "upper_arm": (
        ((0, -0.07, 0), (0, 0.062, 0), 0.06, JOINT),
        ((0, 0.062, 0), (0, 0.074, 0), 0.053, CAP),
        ((0, 0, 0), (0, 0, 0.425), 0.045, SHELL),
        ((0, -0.062, 0.425), (0, 0.055, 0.425), 0.055, JOINT),
        ((0, 0.055, 0.425), (0, 0.066, 0.425), 0.048, CAP),
    ),
    "forearm": (
        ((0, -0.05, 0), (0, 0.07, 0), 0.05, JOINT),
        ((0, -0.061, 0), (0, -0.05, 0), 0.043, CAP),
        ((0, 0, 0), (0, 0, 0.392), 0.037, SHELL),
        ((0, -0.045, 0.392), (0, 0.04, 0.392), 0.042, JOINT),
    ),
    "wrist_1": (
        ((0, -0.045, 0), (0, 0.127, 0), 0.038, JOINT),
        ((0, -0.054, 0), (0, -0.045, 0), 0.032, CAP),
    ),
    "wrist_2": (
        ((0, 0, -0.045), (0, 0, 0.1), 0.038, JOINT),
        ((0, 0, -0.054), (0, 0, -0.045), 0.032, CAP),
    ),
    "wrist_3": (((0, -0.04, 0), (0, 0.085, 0), 0.037, STEEL),),
}


def dress_base(spec: Any, base: BaseParameters) -> None:
    """Show the base that drives, with the arm folded on top."""
    body = spec.body("base")
    for name in ("chassis", "tower"):
        hide(spec.geom(name))
    _add_shell(spec, body, base)
    for side in SIDES:
        wheel = spec.body(f"wheel_{side}")
        paint(spec.geom(f"wheel_{side}"), RUBBER)
        _add_hub(wheel, base)
        for axle, holder in ((AXLES[0], spec.body(f"rocker_{side}")), (AXLES[2], body)):
            ball = spec.geom(f"{axle}_{side}")
            hide(ball)
            _add_caster(holder, ball.pos, base)
    _add_folded_arm(body)


def dress_arm(spec: Any) -> None:
    """Show the arm, its hand, and the block."""
    for name in JOINTS:
        for geom in spec.body(name).geoms:
            hide(geom)
        for start, end, radius, material in _TUBES[name]:
            add_rod(spec.body(name), start, end, radius, material)
    _add_gripper(spec)
    paint(spec.geom("block"), BLOCK)


def dress_pedestal(spec: Any, base: BaseParameters) -> None:
    """Show the base, at a standstill, instead of the pedestal."""
    pedestal = spec.body("pedestal")
    height = float(pedestal.pos[2])
    for geom in pedestal.geoms:
        hide(geom)
    _add_foot(pedestal, 0.0)
    standing = spec.worldbody
    _add_shell(spec, standing, base, height)
    for side in (-1, 1):
        y = side * base.half_track
        for x in (base.front_x, base.rear_x):
            _add_caster(standing, (x, y, base.wheel_radius), base)
        width = base.wheel_half_width
        radius = base.wheel_radius
        add_rod(standing, (0, y - width, radius), (0, y + width, radius), radius, RUBBER)


def _add_shell(
    spec: Any, body: Any, base: BaseParameters, top: float = ArmParameters().pedestal
) -> None:
    """Add the hull of the base and the column of the arm, from the ground clearance up to `top`."""
    x, y, _ = base.chassis_half
    low, high = base.clearance, base.clearance + 2 * base.chassis_half[2]
    lamp = low + 0.135
    _loft(spec, body, "skirt", DARK, (low - 0.02, x - 0.04, y - 0.03), (low + 0.03, x - 0.01, y))
    _loft(
        spec, body, "hull", SHELL,
        (low + 0.03, x - 0.005, y - 0.005), (low + 0.05, x, y), (lamp - 0.012, x, y),
    )  # fmt: skip
    _loft(spec, body, "lamp", LAMP, (lamp - 0.012, x + 0.002, y + 0.002),
          (lamp + 0.012, x + 0.002, y + 0.002))  # fmt: skip
    _loft(
        spec, body, "deck", SHELL,
        (lamp + 0.012, x, y), (high - 0.03, x, y), (high - 0.008, x - 0.018, y - 0.018),
        (high, x - 0.04, y - 0.04),
    )  # fmt: skip
    _loft(spec, body, "plate", DARK, (high, x - 0.06, y - 0.06), (high + 0.006, x - 0.06, y - 0.06))
    for sign in (-1, 1):
        place = (sign * (x - 0.03), sign * (y - 0.04))
        add_rod(body, (*place, low + 0.06), (*place, low + 0.12), 0.045, DARK)
    _loft(spec, body, "column", SHELL, (high, 0.13, 0.13), (high + 0.03, 0.11, 0.11),
          (top - 0.03, 0.1, 0.1), (top, 0.09, 0.09))  # fmt: skip
    add_box(body, (0.106, 0, (high + top) / 2), (0.004, 0.06, 0.07), DARK)


def _loft(spec: Any, body: Any, name: str, material: str, *sections: tuple[float, ...]) -> None:
    """Add a skin over sections: their heights and half sizes. Corners are as round as fits."""
    found = [Section(z, x, y, 0.35 * min(x, y)) for z, x, y in sections]
    add_loft(spec, body, name, found, material)


def _add_hub(wheel: Any, base: BaseParameters) -> None:
    half = base.wheel_half_width + 0.002
    add_rod(wheel, (0, -half, 0), (0, half, 0), 0.55 * base.wheel_radius, STEEL)


def _add_caster(holder: Any, place: Any, base: BaseParameters) -> None:
    """Add a wheel in a fork; it does not turn."""
    x, y, z = (float(each) for each in place)
    radius = base.wheel_radius
    add_rod(holder, (x, y - 0.014, z), (x, y + 0.014, z), radius, RUBBER)
    for side in (-1, 1):
        start, end = (x, y + side * 0.02, z), (x + 0.01, y + side * 0.02, z + radius + 0.01)
        add_limb(holder, start, end, 0.008, STEEL)


def _add_foot(body: Any, top: float) -> None:
    add_rod(body, (0, 0, top), (0, 0, top + 0.1), 0.064, JOINT)
    add_rod(body, (0, 0, top), (0, 0, top + 0.012), 0.08, STEEL)


def _add_gripper(spec: Any) -> None:
    """Add a palm, and two fingers on the sides of the block."""
    arm = ArmParameters()
    hand = spec.body("hand")
    for geom in hand.geoms:
        hide(geom)
    add_rod(hand, (0, -0.02, 0), (0, 0.03, 0), 0.036, DARK)
    add_box(hand, (0, 0.045, 0), (0.05, 0.018, 0.03), DARK)
    half = arm.block_half
    for name, side in zip(FINGERS, (-1, 1), strict=True):
        x = side * (half + 0.007)
        middle = arm.hand_length + 0.006
        add_box(hand, (x, middle, 0), (0.006, 0.048, 0.014), STEEL, name=name)


def _add_folded_arm(body: Any) -> None:
    """Add the arm, folded for the drive. In the physics, the arm is only a mass on the base."""
    arm = ArmParameters()
    _add_foot(body, arm.pedestal)
    spec = new_spec()
    add_arm(spec, arm)
    add_materials(spec)
    dress_arm(spec)
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos[: len(JOINTS)] = _DRIVING
    mujoco.mj_kinematics(model, data)
    moving = {model.body(name).id for name in (*JOINTS, "hand")}
    quaternion = np.zeros(4)
    for index in range(model.ngeom):
        if model.geom_bodyid[index] in moving and model.geom_group[index] == SHOWN_GROUP:
            mujoco.mju_mat2Quat(quaternion, data.geom_xmat[index])
            body.add_geom(
                type=int(model.geom_type[index]),
                size=model.geom_size[index],
                pos=data.geom_xpos[index],
                quat=quaternion.copy(),
                material=model.material(model.geom_matid[index]).name,
                mass=0.0,
                contype=0,
                conaffinity=0,
                group=SHOWN_GROUP,
            )
