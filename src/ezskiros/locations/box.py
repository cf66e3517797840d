"""Conversion of boxes in scenes, with position, orientation and size, to corners on the floor."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product

import shapely

from ezskiros.locations.location import Point
from ezskiros.locations.polygon import around

Quaternion = tuple[float, float, float, float]
"""x, y, z, w (REP 103)."""


def footprint(position: Point, orientation: Quaternion, size: Sequence[float]) -> tuple[Point, ...]:
    """The corners of the shadow that a box casts on the x-y plane, anticlockwise.

    `position` is the middle of the box in m, `size` its edges along its own x, y and z in m.
    Raises `NoPolygonError` if the shadow has no area, or is too far away.
    """
    rows = _rotation(orientation)[:2]
    halves = [(-edge / 2, edge / 2) for edge in size]
    corners = [
        tuple(
            at + math.fsum(turned * part for turned, part in zip(row, corner, strict=True))
            for at, row in zip(position, rows, strict=True)
        )
        for corner in product(*halves)
    ]
    hull = shapely.MultiPoint(corners).convex_hull
    return around(hull if isinstance(hull, shapely.Polygon) else shapely.Polygon())


def _rotation(found: Quaternion) -> tuple[tuple[float, float, float], ...]:
    length = math.hypot(*found)
    x, y, z, w = (number / length for number in found)
    return (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )
