"""Mistakes in zones."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class UnfitShape(Error, code="ROSS280", name="unfit-shape"):
    """A shape of a zone, or a part of a shape, of the wrong form."""

    title = "{part} has to be {expected}"
    label = "this is {found}"
    help = "write `{form}`"
    part: str
    expected: str
    found: str
    form: str

    class FirstAgain(Remark):
        says = "leave the last corner out: a polygon ends where it begins"


class CrossingPolygon(Error, code="ROSS281", name="crossing-polygon"):
    """A polygon whose edges meet other than at its corners."""

    title = "this polygon crosses itself"
    label = "the edge from {edge} ends at the next corner"
    note = "of such a polygon nobody can say with certainty what is inside"
    help = "give the corners in the order in which a line around it meets them"
    edge: str

    class Other(Remark):
        says = "and it meets the one from {edge}"
        edge: str


class EmptyZone(Error, code="ROSS282", name="empty-zone"):
    """A zone without a shape."""

    title = "zone `{zone}` has no shape"
    label = "nothing is ever in it"
    help = "add a shape: `box [0.2, 0.9, -0.4, 0.4] m;`"
    zone: str


ALL: tuple[type[Template], ...] = (UnfitShape, CrossingPolygon, EmptyZone)
