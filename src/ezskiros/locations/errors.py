"""EZS61x: positions and sizes of the individuals in a scene."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template, Warning


class WrongPolygon(Error, code="EZS610", name="wrong-polygon"):
    """A polygon that encloses no area, or is ambiguous."""

    title = "the polygon of {individual} {reason}"
    help = 'write the corners in m and repeat the first corner: "POLYGON ((0 0, 4 0, 4 2, 0 0))"'
    individual: str
    reason: str


class HalfKnown(Warning, code="EZS611", name="half-known-location"):
    """An individual with an incomplete position or size."""

    title = "{individual} has {found} but no {missing}"
    label = "rules cannot locate {individual}"
    help = "add {missing}, or remove {found}"
    individual: str
    found: str
    missing: str


class WrongPlace(Error, code="EZS612", name="wrong-place-of-location"):
    """An invalid coordinate, size or orientation."""

    title = "{property} of {individual} {reason}"
    individual: str
    property: str
    reason: str


ALL: tuple[type[Template], ...] = (WrongPolygon, HalfKnown, WrongPlace)
