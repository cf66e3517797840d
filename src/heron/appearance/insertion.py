"""The appearance of the learning scene: a hole, glass next to it, and the volumes of the rules."""

from __future__ import annotations

from typing import Any

from heron.appearance.holder import add_holder
from heron.appearance.materials import (
    ALLOWED,
    ALLOWED_EDGE,
    AMBER,
    BRASS,
    FORBIDDEN,
    FORBIDDEN_EDGE,
    GLASS,
    RIM,
    ROSE,
    SHELL,
    SPACE_EDGE,
    STEEL,
    WOOD,
)
from heron.appearance.materials import BLOCK as BLUE
from heron.appearance.shapes import add_ball, add_box, add_edges, add_limb, add_rod, hide, paint
from heron.scene.insertion import BLOCK, FRAGILE, PEG, InsertionParameters, Vector

Box = tuple[Vector, Vector]
"""The least and the greatest corner (m)."""
V1: Box = ((-0.93, -0.6, 0.6), (-0.13, 0.6, 1.3))
"""The workspace, as `rules/insertion.ross` has it."""
V2: Box = ((-0.8, 0.1, 0.65), (-0.2, 0.5, 1.3))
"""The volume around the fragile part. Rules keep the peg out of this volume."""
V3: Box = ((-0.66, -0.06, 0.6), (-0.54, 0.06, 0.8))
"""The volume around the hole, in which contact is allowed."""
_TOP = 0.03  # of the table, in height
_CLOSE = 0.003  # by which a volume is shown larger than its content


def dress_insertion(spec: Any, scene: InsertionParameters) -> None:
    """Show a table, a block with its hole, a case with flasks, an arm, and the volumes."""
    _dress_table(spec, scene)
    for geom in spec.worldbody.geoms:
        if geom.name.startswith(BLOCK):
            paint(geom, SHELL)
    for geom in spec.body(PEG).geoms:
        paint(geom, BRASS)
    _dress_fragile(spec, scene)
    add_holder(spec, scene)
    add_edges(spec.worldbody, *V1, 0.0025, SPACE_EDGE)
    _add_volume(spec, V2, FORBIDDEN, FORBIDDEN_EDGE)
    _add_volume(spec, V3, ALLOWED, ALLOWED_EDGE)


def _add_volume(spec: Any, box: Box, faces: str, edges: str) -> None:
    low, high = box
    middle = [(a + b) / 2 for a, b in zip(low, high, strict=True)]
    half = [(b - a) / 2 + _CLOSE for a, b in zip(low, high, strict=True)]
    add_box(spec.worldbody, middle, half, faces)
    add_edges(spec.worldbody, low, high, 0.0025, edges)


def _dress_table(spec: Any, scene: InsertionParameters) -> None:
    """Show a board on a frame instead of the block that fills the space below."""
    hide(spec.geom("table"))
    (x, y, z), (half_x, half_y, half_z) = scene.table
    top = z + half_z
    body = spec.worldbody
    add_box(body, (x, y, top - _TOP / 2), (half_x, half_y, _TOP / 2), WOOD)
    for side in (-1, 1):
        aside = (y - half_y + 0.04, y + half_y - 0.04)
        level = x + side * (half_x - 0.04)
        for height in (0.12, top - _TOP - 0.02):
            add_limb(body, (level, aside[0], height), (level, aside[1], height), 0.016, STEEL)
        for leg in aside:
            add_rod(body, (level, leg, 0.0), (level, leg, top - _TOP), 0.02, STEEL)
    for across in (y - half_y + 0.04, y + half_y - 0.04):
        ends = (x - half_x + 0.04, x + half_x - 0.04)
        height = top - _TOP - 0.02
        add_limb(body, (ends[0], across, height), (ends[1], across, height), 0.016, STEEL)


def _dress_fragile(spec: Any, scene: InsertionParameters) -> None:
    """Show a case of glass, and in it flasks."""
    body = spec.body(FRAGILE)
    for geom in body.geoms:
        paint(geom, GLASS)
    _, half = scene.fragile
    low = [-each for each in half]
    add_edges(body, low, half, 0.004, RIM)
    floor = low[2]
    for share, liquid, size in ((-0.6, AMBER, 0.055), (0.0, BLUE, 0.065), (0.6, ROSE, 0.05)):
        x = share * half[0]
        add_ball(body, (x, 0, floor + size), (size, size, size), liquid)
        neck = floor + 2 * size
        add_rod(body, (x, 0, neck - 0.012), (x, 0, neck + 0.08), 0.016, RIM)
        add_rod(body, (x, 0, neck + 0.08), (x, 0, neck + 0.088), 0.022, RIM)
