"""The dressing of a scene, chosen by the things in the scene."""

from __future__ import annotations

from typing import Any

from heron.appearance.cell import dress_cell
from heron.appearance.insertion import dress_insertion
from heron.appearance.materials import add_light, add_materials
from heron.appearance.robot import dress_arm, dress_base, dress_pedestal
from heron.appearance.surroundings import (
    add_hall,
    dress_course,
    dress_person,
    dress_room,
    dress_table,
)
from heron.scene import BaseParameters, PersonParameters, RoomParameters
from heron.scene.cell import BOX
from heron.scene.insertion import FRAGILE, InsertionParameters
from heron.scene.person import PERSON

_ALONG, _AGAINST = (0.45, 0.5, -1.0), (-0.45, 0.4, -1.0)  # the x axis; to walls that are seen


def dressed(spec: Any) -> Any:
    """A model to be looked at, with the same joints as the scene, in the same order."""
    copy = spec.copy()
    add_materials(copy)
    table = copy.geom("table")
    add_light(copy, _ALONG if table is None else _AGAINST)
    if copy.body("base") is not None:
        dress_base(copy, BaseParameters())
        dress_course(copy)
    elif copy.body(FRAGILE) is not None:
        dress_insertion(copy, InsertionParameters())
    else:
        dress_arm(copy)
        dress_pedestal(copy, BaseParameters())
        if table is not None:
            dress_table(copy, table)
    if table is not None:
        add_hall(copy)
    if copy.geom("right_table") is not None:
        dress_room(copy, RoomParameters())
    if copy.body(BOX) is not None:
        dress_cell(copy)
    if copy.body(PERSON) is not None:
        dress_person(copy, PersonParameters())
    return copy.compile()
