"""Shapes without contact, and generated meshes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product
from typing import Any, NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

Point = Sequence[float]
SHOWN_GROUP = 2
"""The group of geoms for display only."""
HIDDEN_GROUP = 4
"""The group of geoms of the physics that another shape is shown for."""
_GEOM = mujoco.mjtGeom
_COLOR_OF_MATERIAL = (0.5, 0.5, 0.5, 1.0)  # the default, which MuJoCo takes for none
_CORNER = 6  # edges of a rounded corner
_AROUND = 72  # edges of a ring


class Section(NamedTuple):
    """A rectangle with rounded corners, at a height (m)."""

    z: float
    half_x: float
    half_y: float
    radius: float


def add_box(body: Any, pos: Point, half: Point, material: str, **more: Any) -> Any:
    """Add a box by its middle and its half sizes."""
    return _add(body, _GEOM.mjGEOM_BOX, material, pos=pos, size=half, **more)


def add_rod(body: Any, start: Point, end: Point, radius: float, material: str) -> Any:
    """Add a cylinder from point to point."""
    return _add(body, _GEOM.mjGEOM_CYLINDER, material, fromto=[*start, *end], size=[radius, 0, 0])


def add_limb(body: Any, start: Point, end: Point, radius: float, material: str) -> Any:
    """Add a rod with round ends."""
    return _add(body, _GEOM.mjGEOM_CAPSULE, material, fromto=[*start, *end], size=[radius, 0, 0])


def add_ball(body: Any, pos: Point, half: Point, material: str) -> Any:
    """Add an ellipsoid."""
    return _add(body, _GEOM.mjGEOM_ELLIPSOID, material, pos=pos, size=half)


def add_loft(spec: Any, body: Any, name: str, sections: Sequence[Section], material: str) -> Any:
    """Add a skin over sections, ordered from bottom to top, closed at both ends."""
    rings = np.array([_outline(section) for section in sections])
    count = rings.shape[1]
    points = rings.reshape(-1, 3)
    faces = []
    for level in range(len(sections) - 1):
        low, high = level * count, (level + 1) * count
        for index in range(count):
            following = (index + 1) % count
            faces += [
                (low + index, low + following, high + following),
                (low + index, high + following, high + index),
            ]
    top = (len(sections) - 1) * count
    for index in range(1, count - 1):
        faces += [(0, index + 1, index), (top, top + index, top + index + 1)]
    return _add_mesh(spec, body, name, points, faces, material)


def add_ring(spec: Any, name: str, radius: float, width: float, material: str) -> Any:
    """Add a line on the floor, all around."""
    angles = np.linspace(0.0, 2 * math.pi, _AROUND, endpoint=False)
    corners = [(radius - width / 2, 0.001), (radius + width / 2, 0.001)]
    corners += [(radius + width / 2, 0.004), (radius - width / 2, 0.004)]
    points = np.array([(r * math.cos(a), r * math.sin(a), z) for a in angles for r, z in corners])
    faces = []
    for index in range(_AROUND):
        here, there = 4 * index, 4 * ((index + 1) % _AROUND)
        for one in range(4):
            other = (one + 1) % 4
            faces += [
                (here + one, there + one, there + other),
                (here + one, there + other, here + other),
            ]
    return _add_mesh(spec, spec.worldbody, name, points, faces, material)


def add_edges(body: Any, low: Point, high: Point, radius: float, material: str) -> None:
    """Add the edges of a box between two of its corners, as rods."""
    for axis in range(3):
        first, second = (other for other in range(3) if other != axis)
        for one, another in product((low, high), repeat=2):
            start, end = list(low), list(high)
            start[first] = end[first] = one[first]
            start[second] = end[second] = another[second]
            add_limb(body, start, end, radius, material)


def paint(geom: Any, material: str) -> None:
    """Give a geom of the scene a material in place of its color."""
    geom.material = material
    geom.rgba = _COLOR_OF_MATERIAL


def hide(geom: Any) -> None:
    """Show another shape in its place."""
    geom.group = HIDDEN_GROUP


def _outline(section: Section) -> list[tuple[float, float, float]]:
    z, half_x, half_y, radius = section
    points = []
    for quarter, (sign_x, sign_y) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        for step in range(_CORNER + 1):
            angle = math.pi / 2 * (quarter + step / _CORNER)
            x = sign_x * (half_x - radius) + radius * math.cos(angle)
            y = sign_y * (half_y - radius) + radius * math.sin(angle)
            points.append((x, y, z))
    return points


def _add_mesh(
    spec: Any,
    body: Any,
    name: str,
    points: NDArray[np.float64],
    faces: Sequence[tuple[int, int, int]],
    material: str,
) -> Any:
    mesh = spec.add_mesh(name=name)
    mesh.uservert = points.astype(np.float64).ravel().tolist()
    mesh.userface = np.array(faces, dtype=np.int32).ravel().tolist()
    return _add(body, _GEOM.mjGEOM_MESH, material, meshname=name)


def _add(body: Any, kind: Any, material: str, **more: Any) -> Any:
    return body.add_geom(
        type=kind,
        material=material,
        mass=0.0,
        contype=0,
        conaffinity=0,
        group=SHOWN_GROUP,
        **more,
    )
