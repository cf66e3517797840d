"""Positions with a distance from the edges of zones. Rounding could move a point on an edge to the
other side.
"""

from __future__ import annotations

import z3

from rossmarie.analysis.terms import constant
from rossmarie.core import Region

_CLEAR = 0.01  # in m


def clear_of(region: Region, x: z3.ArithRef, y: z3.ArithRef) -> z3.BoolRef:
    """A formula: both coordinates of a point keep a distance from the corners of a region."""
    apart = [
        z3.Or(place > constant(corner + _CLEAR), place < constant(corner - _CLEAR))
        for place, corners in ((x, 0), (y, 1))
        for corner in sorted({each[corners] for part in region.shapes for each in part.corners})
    ]
    return z3.And(apart)
