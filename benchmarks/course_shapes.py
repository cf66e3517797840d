"""Walls and people of a course in the frame of the base: distances and scans.

The outline of the base is a box along its axes; the origin is the center of the base. All lengths
are in m.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Point = tuple[float, float]
Box = tuple[Point, Point]
"""The minimum and the maximum of x, and the minimum and the maximum of y."""

Wall = tuple[float, float, float, float]
"""A line segment: x and y of its start, x and y of its end."""

Round = tuple[float, float, float]
"""A circle: x and y of its center, and its radius."""


@dataclass(frozen=True)
class Pose:
    """The position of a base in the world (m), and its heading (rad)."""

    x: float
    y: float
    heading: float


@dataclass(frozen=True)
class Outline:
    """The outline of the base (m)."""

    half_length: float
    half_width: float


@dataclass(frozen=True)
class Around:
    """All walls and people, in the frame of the base."""

    walls: Sequence[Wall]
    people: Sequence[Round]


def seen_from(pose: Pose, walls: Sequence[Wall], people: Sequence[Round]) -> Around:
    """Walls and people of the world, moved into the frame of the base."""
    cosine, sine = math.cos(pose.heading), math.sin(pose.heading)

    def moved(x: float, y: float) -> Point:
        x, y = x - pose.x, y - pose.y
        return cosine * x + sine * y, cosine * y - sine * x

    ends = [(*moved(*wall[:2]), *moved(*wall[2:])) for wall in walls]
    return Around(ends, [(*moved(x, y), radius) for x, y, radius in people])


def gap(around: Around, outline: Outline) -> float:
    """The distance between the outline and the closest obstacle (m); 0 if they touch."""
    found = [_to_box(x, y, outline) - radius for x, y, radius in around.people]
    found += [_to_wall(wall, outline) for wall in around.walls]
    return max(0.0, min(found, default=math.inf))


def gap_ahead(around: Around, outline: Outline) -> float:
    """The free distance in front of the base if it drives straight on (m)."""
    found = [math.inf, *_ahead(around, outline)]
    return max(0.0, min(found) - outline.half_length)


def _ahead(around: Around, outline: Outline) -> Iterator[float]:
    length, width = outline.half_length, outline.half_width
    for x, y, radius in around.people:
        beside = max(0.0, abs(y) - width)
        if beside < radius and x > 0.0:
            yield x - math.sqrt(radius**2 - beside**2)
    for wall in around.walls:
        part = _inside(wall, ((length, math.inf), (-width, width)))
        if part:
            yield min(wall[0] + share * (wall[2] - wall[0]) for share in part)


def _to_box(x: float, y: float, outline: Outline) -> float:
    return math.hypot(max(0.0, abs(x) - outline.half_length), max(0.0, abs(y) - outline.half_width))


def _to_wall(wall: Wall, outline: Outline) -> float:
    length, width = outline.half_length, outline.half_width
    if _inside(wall, ((-length, length), (-width, width))):
        return 0.0
    corners = [(x, y) for x in (-length, length) for y in (-width, width)]
    ends = (_to_box(*wall[:2], outline), _to_box(*wall[2:], outline))
    return min(*ends, *(_to_point(wall, *corner) for corner in corners))


def _to_point(wall: Wall, x: float, y: float) -> float:
    start_x, start_y, end_x, end_y = wall
    along_x, along_y = end_x - start_x, end_y - start_y
    share = ((x - start_x) * along_x + (y - start_y) * along_y) / (along_x**2 + along_y**2)
    share = max(0.0, min(1.0, share))
    return math.hypot(x - start_x - share * along_x, y - start_y - share * along_y)


def _inside(wall: Wall, box: Box) -> tuple[float, float] | None:
    """The part of a wall that is in a box, as shares of the wall from 0 to 1."""
    enters, leaves = 0.0, 1.0
    for start, end, (low, high) in zip(wall[:2], wall[2:], box, strict=True):
        along = end - start
        if along == 0.0:
            if not low <= start <= high:
                return None
            continue
        one, other = sorted(((low - start) / along, (high - start) / along))
        enters, leaves = max(enters, one), min(leaves, other)
    return (enters, leaves) if enters <= leaves else None


def ranges(around: Around, angles: Floats) -> Floats:
    """The distance to the first obstacle along each beam (m); infinite if there is no obstacle."""
    beam_x, beam_y = np.cos(angles), np.sin(angles)
    found = np.full(len(angles), math.inf)
    for x, y, end_x, end_y in around.walls:
        along_x, along_y = end_x - x, end_y - y
        across = beam_x * along_y - beam_y * along_x
        with np.errstate(divide="ignore", invalid="ignore"):
            far = (x * along_y - y * along_x) / across
            share = (x * beam_y - y * beam_x) / across
        is_hit = (across != 0.0) & (far > 0.0) & (share >= 0.0) & (share <= 1.0)
        found = np.where(is_hit, np.minimum(found, far), found)
    for x, y, radius in around.people:
        ahead = beam_x * x + beam_y * y
        inside = radius**2 - (x**2 + y**2 - ahead**2)
        far = ahead - np.sqrt(np.maximum(inside, 0.0))
        found = np.where((inside >= 0.0) & (far > 0.0), np.minimum(found, far), found)
    return found
