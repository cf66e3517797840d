"""The surroundings of the robot: floors, walls, ramps, tables, and a worker."""

from __future__ import annotations

import math
from typing import Any

from heron.appearance.materials import (
    BAND,
    BOARD,
    CONCRETE,
    GRIP,
    HELMET,
    MARK,
    RUBBER,
    SKIN,
    STEEL,
    STRIPES,
    TILES,
    TROUSERS,
    VEST,
    WALL,
    WARNING,
    WOOD,
)
from heron.appearance.shapes import add_ball, add_box, add_limb, add_ring, add_rod, paint
from heron.scene import CourseParameters, PersonParameters, RoomParameters
from heron.scene.ground import Contact, add_floor
from heron.scene.person import LEGS, PERSON

_PANEL = 0.06
_BRACKET = 0.5  # m, the height of the beams that carry tables


def dress_course(spec: Any) -> None:
    """Show a corridor to a room at a higher level, unless the ground is flat or there are two
    paths.
    """
    found = CourseParameters()
    paint(spec.geom("floor"), TILES)
    for geom in spec.worldbody.geoms:
        if geom.name == "bump":
            paint(geom, STRIPES)
        elif geom.name == "platform":
            paint(geom, CONCRETE)
        elif geom.name.startswith("ramp"):
            paint(geom, GRIP)
            _edge(spec.worldbody, geom, found.ramp_width / 2)
    if spec.geom("rack") is not None:
        paint(spec.geom("rack"), STEEL)
        return
    far = 1.6
    _add_wall(spec.worldbody, (-4.0, far), (found.room_x, far), 0.0, high=2.0)
    if spec.geom("platform") is None:
        return
    height = found.room_height
    x, y = found.room_x + 5.0, found.ramp_width
    _add_wall(spec.worldbody, (found.room_x, y), (x, y), height)
    _add_wall(spec.worldbody, (x, y), (x, found.detour_y - y), height)


def dress_table(spec: Any, top: Any) -> None:
    """Show four legs below its top."""
    paint(top, WOOD)
    x, y, z = (float(each) for each in top.pos)
    half_x, half_y, _ = (float(each) for each in top.size)
    for side_x in (-1, 1):
        for side_y in (-1, 1):
            place = (x + side_x * (half_x - 0.03), y + side_y * (half_y - 0.03))
            add_rod(spec.worldbody, (*place, 0.0), (*place, z), 0.018, STEEL)


def add_hall(spec: Any) -> None:
    """Add a floor and walls around an arm, where the scene has none."""
    add_floor(spec, Contact())
    floor = spec.geom("floor")
    floor.contype = floor.conaffinity = 0
    paint(floor, TILES)
    _add_wall(spec.worldbody, (-3.0, 2.5), (4.0, 2.5), 0.0, high=2.2)
    _add_wall(spec.worldbody, (-3.0, 2.5), (-3.0, -4.0), 0.0, high=2.2)


def dress_room(spec: Any, room: RoomParameters) -> None:
    """Show by a line on the floor how near is close."""
    paint(spec.geom("floor"), TILES)
    add_ring(spec, "close", room.close, 0.05, WARNING)
    for geom in spec.worldbody.geoms:
        if geom.name.startswith("wall"):
            paint(geom, WALL)
    for side in (-1, 1):
        place = (room.half + room.wall_half, side * room.door_half)
        add_box(spec.worldbody, (*place, 0.55), (0.06, 0.04, 0.55), BOARD)
        _dress_bracket(spec, room, side)


def _dress_bracket(spec: Any, room: RoomParameters, side: int) -> None:
    """Show the beam by which the robot carries a table."""
    top = spec.geom("right_table" if side < 0 else "left_table")
    paint(top, WOOD)
    x, y = room.table(side)
    add_limb(spec.worldbody, (0, 0, _BRACKET), (x, y, _BRACKET), 0.022, STEEL)
    add_rod(spec.worldbody, (x, y, _BRACKET), (x, y, room.table_height - 0.04), 0.022, STEEL)


def dress_person(spec: Any, person: PersonParameters) -> None:
    """Show the person in a vest and a helmet."""
    body = spec.body(PERSON)
    materials = (VEST, SKIN, VEST, VEST, SKIN)
    for geom, material in zip(body.geoms, materials, strict=True):
        paint(geom, material)
    low, high, wide = person.hip_height, person.shoulder_height, person.shoulder_half
    add_limb(body, (0, -wide + 0.02, high - 0.01), (0, wide - 0.02, high - 0.01), 0.062, VEST)
    add_ball(body, (0, 0, (low + high) / 2 + 0.08), (0.135, wide - 0.03, 0.3), VEST)
    add_ball(body, (0, 0, low + 0.02), (0.13, 0.17, 0.13), TROUSERS)
    for z, half in ((low + 0.2, 0.178), (high - 0.2, 0.19)):
        add_ball(body, (0, 0, z), (0.158, half, 0.025), BAND)
    head = person.head_height
    add_ball(body, (-0.01, 0, head + 0.045), (0.125, 0.122, 0.085), HELMET)
    add_ball(body, (0.06, 0, head + 0.03), (0.11, 0.09, 0.012), HELMET)
    for side in (-1, 1):
        place = (0.01, side * person.shoulder_half, person.hip_height - 0.06)
        add_ball(body, place, (0.05, 0.035, 0.065), SKIN)
    for name in LEGS:
        leg = spec.body(name)
        for geom in leg.geoms:
            paint(geom, TROUSERS)
        foot = 0.06 - person.hip_height
        add_limb(leg, (-0.04, 0, foot), (0.12, 0, foot), 0.055, RUBBER)


def _edge(body: Any, ramp: Any, half: float) -> None:
    """Add a yellow line along both sides of a piece of a ramp."""
    length = float(ramp.size[0])
    x, y, z = (float(each) for each in ramp.pos)
    pitch = 2 * math.asin(-float(ramp.quat[2]))
    up = float(ramp.size[2])
    middle = (x - up * math.sin(pitch), z + up * math.cos(pitch))
    for side in (-1, 1):
        add_box(
            body,
            (middle[0], y + side * (half - 0.04), middle[1]),
            (length, 0.03, 0.002),
            MARK,
            quat=ramp.quat,
        )


def _add_wall(
    body: Any, start: tuple[float, float], end: tuple[float, float], low: float, high: float = 1.5
) -> None:
    """Add a wall with a board along its foot, from place to place on the map."""
    x, y = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    half = math.dist(start, end) / 2
    turn = math.atan2(end[1] - start[1], end[0] - start[0]) / 2
    quat = [math.cos(turn), 0, 0, math.sin(turn)]
    add_box(body, (x, y, low + high / 2), (half, _PANEL, high / 2), WALL, quat=quat)
    for z, tall in ((0.06, 0.06), (0.9, 0.03)):
        add_box(body, (x, y, low + z), (half, _PANEL + 0.008, tall), BOARD, quat=quat)
