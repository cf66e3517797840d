"""The scene of the contact experiment: a table, a box to push to a mark, a board to wipe, and a
person at the other side of the table.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import mujoco

from heron.scene.arm import ArmParameters, add_arm
from heron.scene.ground import Contact
from heron.scene.person import PersonParameters, add_person
from heron.scene.placing import add_table
from heron.scene.scene import new_spec

BOX, MARK, BOARD, OBSTACLE = "box", "mark", "board", "obstacle"
FOREARM, FOREARM_JOINT = "lower_arm", "lower_arm_gives_way"
STAIN = "stain"
_GEOM = mujoco.mjtGeom
_SKIN = (0.87, 0.68, 0.55, 1)
_STAIN_HALF = (0.011, 0.0006, 0.011)


@dataclass(frozen=True)
class ForearmParameters:
    """A forearm that lies before a stiff body: ISO/TS 15066, table A.3, has 40 N/mm and 2 kg for
    lower arms. Stiffness in N/m, mass in kg, damping in N s/m, lengths in m.
    """

    stiffness: float = 40_000.0
    mass: float = 2.0
    damping: float = 170.0
    radius: float = 0.045
    length: float = 0.42


@dataclass(frozen=True)
class CellParameters:
    """Lengths in m, masses in kg. The arm points along -y. The box is pushed in this direction, and
    the board is at a right angle to it.
    """

    table_height: float = 0.75
    table_middle: tuple[float, float] = (0.0, -0.55)
    table_half: tuple[float, float, float] = (0.62, 0.25, 0.02)
    friction: float = 0.47
    """The friction of the box on the table."""
    box_mass: float = 4.5
    box_half: tuple[float, float, float] = (0.08, 0.05, 0.05)
    box_place: tuple[float, float] = (-0.3, -0.44)
    push_distance: float = 0.16
    """The distance that the box must travel."""
    jam: float | None = None
    """The distance that the box travels if an obstacle is fixed to the table."""
    board_middle: tuple[float, float, float] = (0.32, -0.61, 0.885)
    board_half: tuple[float, float, float] = (0.18, 0.01, 0.115)
    board_friction: float = 0.35
    stroke: tuple[float, float] = (0.20, 0.44)
    """The range on x over which the board is wiped."""
    rows: tuple[float, ...] = (0.94, 0.88)
    """The heights of the strokes."""
    softness: float = 0.03
    """The time constant of the contact of the sponge with other things (s)."""
    person_y: float = -1.02
    """The place of the person, across the table."""
    forearm: ForearmParameters = field(default_factory=ForearmParameters)

    @property
    def mark(self) -> tuple[float, float]:
        """The target position of the center of the box."""
        x, y = self.box_place
        return x, y - self.push_distance

    @property
    def board_face(self) -> float:
        """The y of the side of the board that is wiped."""
        return self.board_middle[1] + self.board_half[1]

    def stains(self) -> Iterator[tuple[float, float, float]]:
        """The places of the stains on the board."""
        first, last = self.stroke
        count = 7
        for row, z in enumerate(self.rows):
            for index in range(count):
                share = (index + 0.25 + 0.5 * row) / count
                yield first + share * (last - first), self.board_face, z


def build_cell(cell: CellParameters, arm: ArmParameters, person: PersonParameters) -> Any:
    """The arm at its home pose, a sponge in its hand."""
    spec = new_spec()
    add_arm(spec, arm)
    contact = Contact(cell.friction, cell.softness)
    top = add_table(spec, cell.table_middle, cell.table_height, cell.table_half, contact)
    top.name = "table"
    _add_box(spec, cell, contact)
    _add_board(spec, cell)
    add_person(spec, person)
    _add_forearm(spec, cell)
    return spec


def _add_box(spec: Any, cell: CellParameters, contact: Contact) -> None:
    """The box, its mark, and the possible obstacle on its path."""
    half, height = cell.box_half, cell.table_height
    body = spec.worldbody.add_body(name=BOX, pos=[*cell.box_place, height + half[2]])
    body.add_freejoint(name=BOX)
    box = body.add_geom(name=BOX, type=_GEOM.mjGEOM_BOX, size=half, mass=cell.box_mass)
    box.rgba = [0.75, 0.6, 0.4, 1]
    contact.apply(box)
    mark = spec.worldbody.add_geom(
        name=MARK,
        type=_GEOM.mjGEOM_BOX,
        pos=[*cell.mark, height],
        size=[half[0] + 0.015, half[1] + 0.015, 0.0005],
        contype=0,
        conaffinity=0,
    )
    mark.rgba = [0.95, 0.77, 0.18, 1]
    if cell.jam is not None:
        x, y = cell.box_place
        thick = 0.02
        obstacle = spec.worldbody.add_geom(
            name=OBSTACLE,
            type=_GEOM.mjGEOM_BOX,
            pos=[x, y - half[1] - cell.jam - thick, height + 0.03],
            size=[half[0], thick, 0.03],
        )
        obstacle.rgba = [0.6, 0.2, 0.2, 1]
        contact.apply(obstacle)


def _add_board(spec: Any, cell: CellParameters) -> None:
    """The board, and its stains: each can be taken away."""
    board = spec.worldbody.add_geom(
        name=BOARD, type=_GEOM.mjGEOM_BOX, pos=cell.board_middle, size=cell.board_half, priority=1
    )
    board.rgba = [0.9, 0.92, 0.95, 1]
    Contact(cell.board_friction, cell.softness).apply(board)
    for index, place in enumerate(cell.stains()):
        stain = spec.worldbody.add_body(name=f"{STAIN}_{index}", mocap=True, pos=place)
        seen = stain.add_geom(type=_GEOM.mjGEOM_BOX, size=_STAIN_HALF, contype=0, conaffinity=0)
        seen.rgba = [0.2, 0.25, 0.5, 1]


def _add_forearm(spec: Any, cell: CellParameters) -> None:
    """The forearm, which points along its y axis and yields along its x axis."""
    forearm = cell.forearm
    elbow = spec.worldbody.add_body(name=FOREARM, mocap=True)
    body = elbow.add_body(name=f"{FOREARM}_flesh")
    body.add_joint(
        name=FOREARM_JOINT,
        type=mujoco.mjtJoint.mjJNT_SLIDE,
        axis=[1, 0, 0],
        stiffness=[forearm.stiffness, 0, 0],
        damping=[forearm.damping, 0, 0],
    )
    geom = body.add_geom(
        name=FOREARM,
        type=_GEOM.mjGEOM_CAPSULE,
        fromto=[0, 0, 0, 0, forearm.length, 0],
        size=[forearm.radius, 0, 0],
        mass=forearm.mass,
    )
    geom.rgba = _SKIN
    Contact(0.5, cell.softness).apply(geom)
