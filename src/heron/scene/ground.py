"""The ground under the wheels: floors, bumps and ramps of boxes and cylinders."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import mujoco

_THICKNESS = 0.2
_OVERLAP = 0.001  # so that no wheel finds a gap between two pieces
SEEN_GROUP = 1
"""The group of geoms that a range scan sees: everything except the robot's own parts."""


@dataclass(frozen=True)
class Contact:
    """The contact of two surfaces. `friction` is the friction of a rubber wheel on the ground.
    `time_constant` (s) is the softness of contacts: with the default of MuJoCo, 0.02 s, a hard
    wheel sinks into a bump that it should climb.
    """

    friction: float = 1.0
    time_constant: float = 0.008

    def apply(self, geom: Any) -> None:
        """Gives a geom these properties."""
        geom.friction = [self.friction, 0.005, 0.0001]
        geom.solref = [self.time_constant, 1.0]


@dataclass(frozen=True)
class Piece:
    """A straight part of a ramp: its length along the surface and how steep it is (rad)."""

    length: float
    slope: float


def add_floor(spec: Any, contact: Contact) -> None:
    """A plane at height 0."""
    floor = spec.worldbody.add_geom(
        name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[30, 30, 0.1]
    )
    floor.rgba = [0.75, 0.76, 0.78, 1]
    floor.group = SEEN_GROUP
    contact.apply(floor)


def add_bump(spec: Any, contact: Contact, x: float, height: float, radius: float) -> None:
    """A cable duct across the path: a cylinder with only `height` above the ground."""
    axis = height - radius
    bump = spec.worldbody.add_geom(
        name="bump",
        type=mujoco.mjtGeom.mjGEOM_CYLINDER,
        fromto=[x, -1.2, axis, x, 1.2, axis],
        size=[radius, 0, 0],
    )
    bump.rgba = [0.9, 0.75, 0.2, 1]
    bump.group = SEEN_GROUP
    contact.apply(bump)


def ramp_pieces(slope: float, height: float, transition: float, transitions: int) -> list[Piece]:
    """A ramp up to `height`: the slope grows in steps, stays, and falls in the same steps.

    Without the steps, the nose of a base hits the toe of a steep ramp and its belly the crest.
    """
    steps = [slope * (index + 1) / (transitions + 1) for index in range(transitions)]
    ends = [Piece(transition, step) for step in steps]
    gained = 2 * sum(piece.length * math.sin(piece.slope) for piece in ends)
    if gained >= height:
        raise ValueError(f"a slope of {slope:.2f} rad is over at {gained:.2f} m, before the top")
    return [*ends, Piece((height - gained) / math.sin(slope), slope), *reversed(ends)]


def run_of(pieces: Sequence[Piece]) -> float:
    """The length of a ramp on a map."""
    return sum(piece.length * math.cos(piece.slope) for piece in pieces)


def add_ramp(
    spec: Any,
    contact: Contact,
    name: str,
    toe: tuple[float, float],
    pieces: Sequence[Piece],
    width: float,
) -> None:
    """A ramp in the direction of x from its toe (x, y) on the floor."""
    x, y = toe
    z = 0.0
    for index, piece in enumerate(pieces):
        sine, cosine = math.sin(piece.slope), math.cos(piece.slope)
        end_x, end_z = x + piece.length * cosine, z + piece.length * sine
        middle = (
            (x + end_x) / 2 + sine * _THICKNESS / 2,
            y,
            (z + end_z) / 2 - cosine * _THICKNESS / 2,
        )
        box = spec.worldbody.add_geom(
            name=f"{name}_{index}",
            type=mujoco.mjtGeom.mjGEOM_BOX,
            pos=middle,
            quat=[math.cos(piece.slope / 2), 0, -math.sin(piece.slope / 2), 0],
            size=[piece.length / 2 + _OVERLAP, width / 2, _THICKNESS / 2],
        )
        box.rgba = [0.6, 0.65, 0.7, 1]
        box.group = SEEN_GROUP
        contact.apply(box)
        x, z = end_x, end_z


def add_platform(
    spec: Any, contact: Contact, low: tuple[float, float], high: tuple[float, float], height: float
) -> None:
    """A raised floor between two corners on the map."""
    box = spec.worldbody.add_geom(
        name="platform",
        type=mujoco.mjtGeom.mjGEOM_BOX,
        pos=[(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, height / 2],
        size=[(high[0] - low[0]) / 2, (high[1] - low[1]) / 2, height / 2],
    )
    box.rgba = [0.7, 0.72, 0.68, 1]
    box.group = SEEN_GROUP
    contact.apply(box)
