"""Mistakes in zones."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class UnfitShape(Error, code="ROSS280", name="unfit-shape"):
    """A shape of a zone, or a part of a shape, of the wrong form."""

    title = "{part} must be {expected}"
    label = "this is {found}"
    help = "write `{form}`"
    part: str
    expected: str
    found: str
    form: str

    class FirstAgain(Remark):
        says = "remove the last corner: the polygon closes itself"


class CrossingPolygon(Error, code="ROSS281", name="crossing-polygon"):
    """A polygon whose edges meet other than at its corners."""

    title = "this polygon crosses itself"
    label = "the edge from {edge} to the next corner"
    note = "the inside of a polygon that crosses itself is not defined"
    help = "give the corners in their order along the outline"
    edge: str

    class Other(Remark):
        says = "it meets the edge from {edge}"
        edge: str


class EmptyZone(Error, code="ROSS282", name="empty-zone"):
    """A zone without a shape."""

    title = "zone `{zone}` has no shape"
    label = "nothing can be in this zone"
    help = "add a shape: `box [0.2, 0.9, -0.4, 0.4] m;`"
    zone: str


ALL: tuple[type[Template], ...] = (UnfitShape, CrossingPolygon, EmptyZone)
