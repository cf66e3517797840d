"""The two routes of experiment VI: from a junction to a hall, straight on or through a yard.
Pallets and trolleys block them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import mujoco

from heron.scene.base import BaseParameters, add_base
from heron.scene.ground import SEEN_GROUP, Contact, add_floor
from heron.scene.scene import new_spec

Point = tuple[float, float]
_BOX = mujoco.mjtGeom.mjGEOM_BOX


@dataclass(frozen=True)
class StraightPath:
    """A straight path between two places on the map (m)."""

    start: Point
    end: Point

    @property
    def length(self) -> float:
        """Its length (m)."""
        return math.dist(self.start, self.end)

    @property
    def heading(self) -> float:
        """The direction in which it leads (rad)."""
        return math.atan2(self.end[1] - self.start[1], self.end[0] - self.start[0])

    def at(self, along: float, left: float = 0.0) -> Point:
        """The point at this distance along the path (m), and at this distance to its left (m)."""
        cosine, sine = math.cos(self.heading), math.sin(self.heading)
        x, y = self.start
        return x + along * cosine - left * sine, y + along * sine + left * cosine

    def beside(self, point: Point) -> tuple[float, float]:
        """The distance of a point along the path (m), and its distance to the left (m)."""
        cosine, sine = math.cos(self.heading), math.sin(self.heading)
        x, y = point[0] - self.start[0], point[1] - self.start[1]
        return x * cosine + y * sine, y * cosine - x * sine


@dataclass(frozen=True)
class PathsParameters:
    """Lengths in m. The places are the places of `skills/blocked.turtle`. An obstacle is `across`
    wide, and `depth` long along the path. A rack stands between the paths.
    """

    start: Point = (0.0, 0.0)
    junction: Point = (4.0, 0.0)
    hall: Point = (16.0, 0.0)
    yard: Point = (10.0, -9.0)
    depth: float = 0.8
    across: float = 1.2
    height: float = 1.0
    rack: Point = (10.0, -3.2)
    rack_half: float = 1.0

    @property
    def first(self) -> StraightPath:
        """The path straight on."""
        return StraightPath(self.junction, self.hall)

    @property
    def second(self) -> StraightPath:
        """The last part of the other path: from the yard to the hall."""
        return StraightPath(self.yard, self.hall)


def build_paths(found: PathsParameters, base: BaseParameters, obstacles: Sequence[str]) -> Any:
    """The base at the start, and obstacles by their names, which are yet to be put somewhere."""
    spec = new_spec()
    contact = Contact()
    add_floor(spec, contact)
    half = found.rack_half
    rack = spec.worldbody.add_geom(
        name="rack", type=_BOX, pos=[*found.rack, half], size=[half, half, half]
    )
    rack.rgba = [0.45, 0.5, 0.58, 1]
    rack.group = SEEN_GROUP
    add_base(spec, base, contact)
    spec.body("base").pos = [*found.start, 0.0]
    for name in obstacles:
        body = spec.worldbody.add_body(name=name, mocap=True)
        size = [found.depth / 2, found.across / 2, found.height / 2]
        box = body.add_geom(name=name, type=_BOX, pos=[0, 0, found.height / 2], size=size)
        box.rgba = [0.72, 0.53, 0.3, 1]
        box.group = SEEN_GROUP
    return spec
