"""The scene of the experiment with a human: the arm carries its block in a room with a door."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import mujoco

from heron.scene.arm import ArmParameters, add_arm
from heron.scene.ground import SEEN_GROUP, Contact, add_floor
from heron.scene.person import PersonParameters, add_person
from heron.scene.placing import add_table
from heron.scene.scene import new_spec

_TABLE_HALF = (0.12, 0.12, 0.02)


@dataclass(frozen=True)
class RoomParameters:
    """Lengths in m, angles in rad. The arm stands in the middle, and the door is in the wall at +x.
    The tables are brackets on the robot, so only the person stands on the floor.
    """

    half: float = 4.0
    wall_half: float = 0.05
    wall_height: float = 1.0
    door_half: float = 0.6
    scanner_height: float = 0.2
    table_height: float = 0.75
    table_radius: float = 0.51
    table_angle: float = math.radians(40)
    """To both sides of -y."""

    close: float = 2.36
    """Nearer than this to the middle a person is close, as the rules have it."""

    def table(self, side: int) -> tuple[float, float]:
        """The position of the table on one side (-1 or 1)."""
        angle = -math.pi / 2 + side * self.table_angle
        return self.table_radius * math.cos(angle), self.table_radius * math.sin(angle)

    def is_inside(self, x: float, y: float) -> bool:
        """Say whether a place is in the room."""
        return abs(x) < self.half and abs(y) < self.half


def build_room(room: RoomParameters, arm: ArmParameters, person: PersonParameters) -> Any:
    """The arm at its home pose, the block in its hand, and a person somewhere."""
    spec = new_spec()
    add_floor(spec, Contact())
    add_arm(spec, arm)
    spec.worldbody.add_site(name="scanner", pos=[0, 0, room.scanner_height])
    for name, side in (("right_table", -1), ("left_table", 1)):
        table = add_table(spec, room.table(side), room.table_height, _TABLE_HALF, Contact())
        table.name = name
    for index, (place, half) in enumerate(_walls(room)):
        wall = spec.worldbody.add_geom(
            name=f"wall_{index}",
            type=mujoco.mjtGeom.mjGEOM_BOX,
            pos=[*place, room.wall_height / 2],
            size=[*half, room.wall_height / 2],
            contype=0,
            conaffinity=0,
            group=SEEN_GROUP,
        )
        wall.rgba = [0.8, 0.82, 0.85, 1]
    add_person(spec, person)
    return spec


Flat = tuple[float, float]


def _walls(room: RoomParameters) -> list[tuple[Flat, Flat]]:
    """The centre and half size of each wall."""
    out, thin = room.half + room.wall_half, room.wall_half
    beside = (room.half - room.door_half) / 2
    return [
        ((-out, 0.0), (thin, room.half)),
        ((0.0, out), (room.half, thin)),
        ((0.0, -out), (room.half, thin)),
        ((out, room.door_half + beside), (thin, beside)),
        ((out, -room.door_half - beside), (thin, beside)),
    ]
