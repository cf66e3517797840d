"""Conversion of polygons in scenes from well-known text to corners.

The text is that of GeoSPARQL's `geo:asWKT` (OGC 22-047r1). Shapely reads it and finds edges that
cross each other.
"""

from __future__ import annotations

import re

import numpy as np
import shapely

from ezskiros.locations.location import FARTHEST, NoPolygonError, Point

MOST_CORNERS = 1000

_KIND = re.compile(r"\s*([A-Za-z]+)")
_CROSSING = re.compile(r"(?:Ring )?Self-intersection\[(\S+) (\S+)\]")


def corners_of(text: str) -> tuple[Point, ...]:
    """The corners of a polygon, anticlockwise. Raises `NoPolygonError`."""
    if text.lstrip().startswith("<"):
        raise NoPolygonError("names a coordinate system; use the frame of the individual")
    kind = _KIND.match(text)
    if kind is None or kind[1].upper() != "POLYGON":  # other types can be nested without limit
        raise NoPolygonError("does not begin with POLYGON")
    try:
        with np.errstate(all="ignore"):  # NaN is rejected below
            found = shapely.from_wkt(text)
    except shapely.errors.ShapelyError as problem:
        raise NoPolygonError(f"is not well-known text: {_said(problem)}") from None
    assert isinstance(found, shapely.Polygon), "so its text begins"
    if found.is_empty:
        raise NoPolygonError("is empty")
    if found.has_z:
        raise NoPolygonError("has heights; use two coordinates per corner")
    if len(found.interiors) > 0:
        raise NoPolygonError("has a hole; split the area into two polygons of two individuals")
    return around(found)


def around(found: shapely.Polygon) -> tuple[Point, ...]:
    """The corners of a polygon without holes, anticlockwise. Raises `NoPolygonError`."""
    corners = list(found.exterior.coords)[:-1]
    if len(corners) > MOST_CORNERS:
        raise NoPolygonError(f"has {len(corners)} corners; at most {MOST_CORNERS} are allowed")
    if not all(abs(number) <= FARTHEST for corner in corners for number in corner):
        raise NoPolygonError(f"has a coordinate that is not a number up to {FARTHEST:.0f} m")
    if not found.is_valid:
        raise NoPolygonError(_fault(found))
    ordered = shapely.geometry.polygon.orient(found).exterior.coords[:-1]
    return tuple((float(x), float(y)) for x, y in ordered)


def _fault(found: shapely.Polygon) -> str:
    said = str(shapely.is_valid_reason(found))
    crossing = _CROSSING.fullmatch(said)
    if crossing is None:
        return f"is not valid: {said}"
    return f"crosses or touches itself at ({crossing[1]}, {crossing[2]})"


def _said(problem: Exception) -> str:
    return str(problem).partition(": ")[2] or str(problem)
