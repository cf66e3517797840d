"""The appearance of the arm that holds the peg. The scene only has its hand, which slides along
three axes; the links above it follow the hand.
"""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from heron.appearance.materials import CAP, DARK, JOINT, RUBBER, SHELL, STEEL
from heron.appearance.shapes import Section, add_box, add_loft, add_rod, hide
from heron.scene.insertion import InsertionParameters

_SHOULDER, _UPPER, _FOREARM, _WRIST = _LINKS = (
    "holder_shoulder", "holder_upper", "holder_forearm", "holder_wrist",
)  # fmt: skip
_FOOT = (-1.08, 0.02)
_HEIGHT = 1.0  # of the shoulder
_LENGTHS = (0.66, 0.64)
_ASIDE = 0.13  # of the upper arm, from the plane of the forearm
_ABOVE = 0.36  # of the wrist, above the lower end of the peg
_TUBES = {  # from, to, radius and material, in the frame of each link (m)
    _SHOULDER: (
        ((0, 0, -0.12), (0, 0, 0.075), 0.082, JOINT),
        ((0, 0, 0.075), (0, 0, 0.088), 0.072, CAP),
        ((0, 0, 0), (0, _ASIDE - 0.07, 0), 0.075, JOINT),
    ),
    _UPPER: (
        ((0, _ASIDE - 0.075, 0), (0, _ASIDE + 0.07, 0), 0.08, JOINT),
        ((0, _ASIDE + 0.07, 0), (0, _ASIDE + 0.084, 0), 0.07, CAP),
        ((0, _ASIDE, 0), (0, _ASIDE, _LENGTHS[0]), 0.06, SHELL),
        ((0, _ASIDE - 0.07, _LENGTHS[0]), (0, _ASIDE + 0.062, _LENGTHS[0]), 0.068, JOINT),
        ((0, _ASIDE + 0.062, _LENGTHS[0]), (0, _ASIDE + 0.075, _LENGTHS[0]), 0.058, CAP),
    ),
    _FOREARM: (
        ((0, -0.062, 0), (0, 0.07, 0), 0.064, JOINT),
        ((0, -0.075, 0), (0, -0.062, 0), 0.054, CAP),
        ((0, 0, 0), (0, 0, _LENGTHS[1]), 0.046, SHELL),
        ((0, -0.05, _LENGTHS[1]), (0, 0.05, _LENGTHS[1]), 0.052, JOINT),
        ((0, -0.061, _LENGTHS[1]), (0, -0.05, _LENGTHS[1]), 0.044, CAP),
        ((0, 0.05, _LENGTHS[1]), (0, 0.061, _LENGTHS[1]), 0.044, CAP),
    ),
    _WRIST: (
        ((0, 0, 0), (0, 0, 0.12), 0.044, SHELL),
        ((0, 0, 0.12), (0, 0, 0.165), 0.047, JOINT),
        ((0, 0, 0.165), (0, 0, 0.176), 0.04, STEEL),
    ),
}  # fmt: skip


def add_holder(spec: Any, scene: InsertionParameters) -> None:
    """Show an arm on a column, and a gripper around the peg."""
    _add_column(spec)
    body = spec.worldbody
    places = ((*_FOOT, _HEIGHT), (0, 0, 0), (0, 0, _LENGTHS[0]), (0, 0, _LENGTHS[1]))
    for name, place in zip(_LINKS, places, strict=True):
        body = body.add_body(name=name, pos=place)
        for start, end, radius, material in _TUBES[name]:
            add_rod(body, start, end, radius, material)
    _add_gripper(spec, scene)


def holder_of(model: Any) -> Holder | None:
    """The arm that `add_holder` has added to a model, if it has."""
    is_there = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, _WRIST) >= 0
    return Holder(model) if is_there else None


class Holder:
    """An arm that reaches for its hand, which points downwards."""

    def __init__(self, model: Any) -> None:
        self._links = [model.body(name).id for name in _LINKS]

    def hold(self, model: Any, peg: NDArray[np.float64]) -> None:
        """Turn the links so that the arm holds the peg at a position (m). The arm points at a peg
        that is out of reach.
        """
        x, y, z = peg.tolist()
        x, y, z = x - _FOOT[0], y - _FOOT[1], z + _ABOVE - _HEIGHT
        upper, forearm = _reach(math.hypot(x, y), z)
        turns = (upper, forearm - upper, math.pi - forearm)
        model.body_quat[self._links[0]] = _turned(math.atan2(y, x), 3)
        for link, turn in zip(self._links[1:], turns, strict=True):
            model.body_quat[link] = _turned(turn, 2)


def _reach(along: float, up: float) -> tuple[float, float]:
    """The angles of upper arm and forearm from the vertical (rad), with the elbow above, for a
    wrist at this distance from the shoulder (m).
    """
    first, second = _LENGTHS
    far = max(math.hypot(along, up), abs(first - second))
    towards = math.atan2(along, up)
    return towards - _corner(first, far, second), towards + _corner(second, far, first)


def _corner(side: float, other: float, opposite: float) -> float:
    """The angle between two sides of a triangle (rad), or the nearest possible angle."""
    cosine = (side**2 + other**2 - opposite**2) / (2 * side * other)
    return math.acos(min(max(cosine, -1.0), 1.0))


def _turned(angle: float, axis: int) -> NDArray[np.float64]:
    """A quaternion w, x, y, z, by the place of its axis there."""
    found = np.zeros(4)
    found[0], found[axis] = math.cos(angle / 2), math.sin(angle / 2)
    return found


def _add_column(spec: Any) -> None:
    sections = (
        (0.0, 0.17), (0.02, 0.17), (0.035, 0.15), (0.06, 0.115), (_HEIGHT - 0.16, 0.095),
        (_HEIGHT - 0.14, 0.09),
    )  # fmt: skip
    lofted = [Section(z, half, half, 0.6 * half) for z, half in sections]
    column = spec.worldbody.add_body(name="holder_column", pos=(*_FOOT, 0.0))
    add_loft(spec, column, "holder_column", lofted, SHELL)
    add_rod(column, (0, 0, _HEIGHT - 0.14), (0, 0, _HEIGHT - 0.115), 0.092, DARK)
    add_rod(column, (0, 0, _HEIGHT - 0.125), (0, 0, _HEIGHT - 0.1), 0.086, STEEL)


def _add_gripper(spec: Any, scene: InsertionParameters) -> None:
    """Show two fingers on the sides of the peg, which end above the block when it is inserted."""
    hand = spec.body("hand")
    for geom in hand.geoms:
        hide(geom)
    top, half = scene.peg_length, scene.peg_half
    add_rod(hand, (0, 0, top + 0.066), (0, 0, _ABOVE - 0.17), 0.043, DARK)
    add_box(hand, (0, 0, top + 0.052), (0.058, 0.03, 0.016), DARK)
    add_box(hand, (0, 0, top + 0.032), (0.046, 0.024, 0.006), STEEL)
    for side in (-1, 1):
        x = side * (half + 0.008)
        add_box(hand, (x, 0, top), (0.006, 0.015, 0.042), STEEL)
        add_box(hand, (x - side * 0.007, 0, top - 0.018), (0.0015, 0.014, 0.022), RUBBER)
