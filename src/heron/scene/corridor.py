"""The corridor of experiment V: long, with walls on both sides, and a door of a classroom."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco

from heron.scene.base import BaseParameters, add_base
from heron.scene.ground import SEEN_GROUP, Contact, add_floor
from heron.scene.person import PersonParameters, add_person
from heron.scene.scene import new_spec

CHILD = PersonParameters(
    hip_height=0.55,
    hip_half=0.07,
    leg_radius=0.05,
    shoulder_height=0.92,
    shoulder_half=0.14,
    torso_radius=0.1,
    arm_radius=0.03,
    head_radius=0.09,
    head_height=1.08,
)
"""A child of 1.17 m, about six years old."""


@dataclass(frozen=True)
class CorridorParameters:
    """Lengths in m. The corridor lies along x. `school` are the ends of the part that belongs to a
    school, as in `heron:SchoolCorridor-3` in `skills/corridor.turtle`. The door is in the wall on
    the left, with its center at `door_x`.
    """

    begin: float = -27.0
    end: float = 27.0
    half_width: float = 1.5
    school: tuple[float, float] = (4.5, 7.5)
    door_x: float = 6.0
    door_width: float = 0.9
    wall_height: float = 2.0
    wall_half: float = 0.1


def build_corridor(found: CorridorParameters, base: BaseParameters, child: PersonParameters) -> Any:
    """The base at the beginning of the corridor, and a child without a position yet."""
    spec = new_spec()
    contact = Contact()
    add_floor(spec, contact)
    left, right = found.half_width + found.wall_half, -found.half_width - found.wall_half
    near, far = found.door_x - found.door_width / 2, found.door_x + found.door_width / 2
    outer = 2.0  # m behind both ends
    _add_wall(spec, found, "left_before", (found.begin - outer, near), left)
    _add_wall(spec, found, "left_behind", (far, found.end + outer), left)
    _add_wall(spec, found, "right", (found.begin - outer, found.end + outer), right)
    add_base(spec, base, contact)
    spec.body("base").pos = [found.begin, 0.0, 0.0]
    add_person(spec, child)
    return spec


def _add_wall(
    spec: Any, found: CorridorParameters, name: str, ends: tuple[float, float], y: float
) -> None:
    height = found.wall_height / 2
    wall = spec.worldbody.add_geom(
        name=name,
        type=mujoco.mjtGeom.mjGEOM_BOX,
        pos=[sum(ends) / 2, y, height],
        size=[(ends[1] - ends[0]) / 2, found.wall_half, height],
    )
    wall.rgba = [0.88, 0.86, 0.8, 1]
    wall.group = SEEN_GROUP
