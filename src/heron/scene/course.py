"""The course of the navigation experiment: a corridor with a bump, and a room on a higher level.

Two ramps lead to the room. The short route goes straight on, and its slope differs between the
variants of the experiment. The other route is a detour and always gentle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from heron.scene.ground import (
    Contact,
    add_bump,
    add_floor,
    add_platform,
    add_ramp,
    ramp_pieces,
    run_of,
)
from heron.variants import Terrain


@dataclass(frozen=True)
class Slope:
    """A stretch of the course where the ground rises: on the map, from x to x at one y."""

    start_x: float
    end_x: float
    y: float
    angle: float


@dataclass(frozen=True)
class CourseParameters:
    """Lengths in m, angles in rad. The fields that depend on the seed come first."""

    bump_x: float = 2.5
    bump_height: float = 0.025
    friction: float = 1.0
    bump_radius: float = 0.2
    gentle: float = math.radians(12)
    steep: float = math.radians(25)
    transition: float = 0.3
    transitions: int = 3
    room_x: float = 10.0
    room_height: float = 0.8
    detour_y: float = -3.0
    junction_x: float = 4.2
    ramp_width: float = 2.0
    block_away: float = 0.5
    """The distance between the block and the target position of the base."""


Point = tuple[float, float]


@dataclass(frozen=True)
class Course:
    """The positions of all things. `routes` lead from the start to the block, the preferred route
    first.
    """

    terrain: Terrain
    parameters: CourseParameters
    slopes: tuple[Slope, ...]
    routes: tuple[tuple[Point, ...], ...]

    @property
    def block(self) -> Point:
        """The position of the block to pick up: on the right, seen from the shortest route."""
        (from_x, from_y), (x, y) = self.routes[0][-2:]
        heading = math.atan2(y - from_y, x - from_x)
        away = self.parameters.block_away
        return x + away * math.sin(heading), y - away * math.cos(heading)

    @property
    def bump(self) -> tuple[float, float] | None:
        """The range of the bump along the corridor."""
        if self.terrain is Terrain.FLAT:
            return None
        found = self.parameters
        depth = found.bump_radius - found.bump_height
        half = math.sqrt(found.bump_radius**2 - depth**2)
        return found.bump_x - half, found.bump_x + half


def course(terrain: Terrain, parameters: CourseParameters) -> Course:
    """The course of a variant."""
    x, detour = parameters.room_x, parameters.detour_y
    end = (x + 2.0, detour / 2)
    direct = ((0.0, 0.0), (x + 0.8, 0.0), end)
    junction = parameters.junction_x
    around = ((0.0, 0.0), (junction, 0.0), (junction, detour), (x + 0.8, detour), end)
    angles = {
        Terrain.FLAT: (),
        Terrain.GENTLE: ((0.0, parameters.gentle), (detour, parameters.gentle)),
        Terrain.STEEP: ((0.0, parameters.steep), (detour, parameters.gentle)),
    }[terrain]
    slopes = tuple(
        Slope(x - run_of(_pieces(angle, parameters)), x, y, angle) for y, angle in angles
    )
    return Course(terrain, parameters, slopes, (direct, around))


def add_course(spec: Any, built: Course) -> Contact:
    """Floor, bump, ramps and the room; gives how wheels touch them."""
    found = built.parameters
    contact = Contact(friction=found.friction)
    add_floor(spec, contact)
    if built.terrain is Terrain.FLAT:
        return contact
    add_bump(spec, contact, found.bump_x, found.bump_height, found.bump_radius)
    for index, slope in enumerate(built.slopes):
        toe, pieces = (slope.start_x, slope.y), _pieces(slope.angle, found)
        add_ramp(spec, contact, f"ramp_{index}", toe, pieces, found.ramp_width)
    margin = found.ramp_width
    low = (found.room_x, found.detour_y - margin)
    add_platform(spec, contact, low, (found.room_x + 5, margin), found.room_height)
    return contact


def _pieces(angle: float, parameters: CourseParameters) -> Any:
    return ramp_pieces(angle, parameters.room_height, parameters.transition, parameters.transitions)
