"""A location: an individual of a scene with a position in the plane of a frame."""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.source import Span

Point = tuple[float, float]
"""x and y in m."""

FARTHEST = 1e6
"""The greatest coordinate in m. Its floating-point resolution is a ten-millionth of a millimetre.
"""


class NoPolygonError(ValueError):
    """An invalid polygon. The message continues the text `the polygon of X`."""


@dataclass(frozen=True)
class Location:
    """An individual at a point, or one that covers a polygon.

    `types` are the IRIs of its classes, sorted. `corners` are in m, in the x-y plane of `frame`
    (REP 105, such as `map`): one corner is a point; three or more go around a polygon
    anticlockwise, and the last one is not the first again.
    """

    iri: str
    label: str
    types: tuple[str, ...]
    frame: str
    corners: tuple[Point, ...]
    span: Span
