"""The appearance of the cell with a box, a board, and a person who reaches over the table."""

from __future__ import annotations

from typing import Any

from heron.appearance.materials import BAND, CARDBOARD, INK, SHELL, SKIN, STEEL, VEST, WARNING
from heron.appearance.materials import MARK as YELLOW
from heron.appearance.shapes import add_ball, add_box, add_limb, paint
from heron.scene.cell import BOARD, BOX, FOREARM, MARK, OBSTACLE, STAIN

_FRAME = 0.006


def dress_cell(spec: Any) -> None:
    """Show a parcel and its mark, a framed board with stains, and a sleeve on the forearm."""
    paint(spec.geom(MARK), YELLOW)
    if spec.geom(OBSTACLE) is not None:
        paint(spec.geom(OBSTACLE), WARNING)
    for body in spec.worldbody.bodies:
        if body.name.startswith(STAIN):
            paint(body.geoms[0], INK)
    _dress_box(spec)
    _dress_board(spec)
    _dress_forearm(spec)


def _dress_box(spec: Any) -> None:
    """Add a strip of tape."""
    paint(spec.geom(BOX), CARDBOARD)
    half_x, _, half_z = (float(each) for each in spec.geom(BOX).size)
    add_box(spec.body(BOX), (0, 0, half_z), (half_x - 0.004, 0.012, 0.0012), BAND)


def _dress_board(spec: Any) -> None:
    """Add a frame."""
    board = spec.geom(BOARD)
    paint(board, SHELL)
    x, y, z = (float(each) for each in board.pos)
    half_x, half_y, half_z = (float(each) for each in board.size)
    thick = half_y + 0.004
    for side in (-1, 1):
        upright = (x + side * (half_x + _FRAME), y, z)
        add_box(spec.worldbody, upright, (_FRAME, thick, half_z + 2 * _FRAME), STEEL)
        level = (x, y, z + side * (half_z + _FRAME))
        add_box(spec.worldbody, level, (half_x, thick, _FRAME), STEEL)


def _dress_forearm(spec: Any) -> None:
    """Add a sleeve and a hand."""
    flesh, arm = spec.body(f"{FOREARM}_flesh"), spec.geom(FOREARM)
    paint(arm, SKIN)
    length, radius = float(arm.fromto[4]), float(arm.size[0])
    add_limb(flesh, (0, 0, 0), (0, 0.55 * length, 0), radius + 0.006, VEST)
    add_ball(flesh, (0, length, 0), (0.05, 0.07, 0.03), SKIN)
