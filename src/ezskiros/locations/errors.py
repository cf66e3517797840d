"""EZS61x: where the things of a scene are."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template, Warning


class WrongPolygon(Error, code="EZS610", name="wrong-polygon"):
    """A polygon that encloses nothing, or nobody knows what."""

    title = "the polygon of {thing} {reason}"
    help = (
        'write the corners in m, the first one again at the end: "POLYGON ((0 0, 4 0, 4 2, 0 0))"'
    )
    thing: str
    reason: str


class HalfKnown(Warning, code="EZS611", name="half-known-location"):
    """A thing whose place or size has a part that is missing."""

    title = "{thing} has {found}, and no {missing}"
    label = "rules cannot know where {thing} is"
    help = "add {missing}, or remove {found}"
    thing: str
    found: str
    missing: str


class WrongPlace(Error, code="EZS612", name="wrong-place-of-location"):
    """A coordinate, a size or an orientation that no thing has."""

    title = "{property} of {thing} {reason}"
    thing: str
    property: str
    reason: str


ALL: tuple[type[Template], ...] = (WrongPolygon, HalfKnown, WrongPlace)
