"""Places clear of the edges of zones: by rounding, what lies on one comes to the other side."""

from __future__ import annotations

import z3

from rossmarie.analysis.terms import constant
from rossmarie.core import Region

_CLEAR = 0.01  # in m


def clear_of(region: Region, x: z3.ArithRef, y: z3.ArithRef) -> z3.BoolRef:
    """A formula: a point is not level with a corner of a region, in either direction."""
    apart = [
        z3.Or(place > constant(corner + _CLEAR), place < constant(corner - _CLEAR))
        for place, corners in ((x, 0), (y, 1))
        for corner in sorted({each[corners] for part in region.shapes for each in part.corners})
    ]
    return z3.And(apart)
