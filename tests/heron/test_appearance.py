"""The look of scenes: the physics knows nothing of it."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

import mujoco

from heron.appearance import Stage, moment_of
from heron.appearance.insertion import V1, V2, V3
from heron.appearance.robot import FINGERS
from heron.robot import Arm
from heron.robot.physics import Physics
from heron.rules import FOLDER
from heron.scene import (
    ArmParameters,
    BaseParameters,
    CourseParameters,
    PersonParameters,
    RoomParameters,
    TableParameters,
    build_navigation,
    build_placing,
    build_room,
    course,
)
from heron.scene.arm import GRIP, LINKS
from heron.scene.insertion import InsertionParameters, build_insertion
from heron.variants import Terrain

Builder = Callable[[], Any]


def drive(terrain: Terrain) -> Any:
    return build_navigation(course(terrain, CourseParameters()), BaseParameters())


SCENES: dict[str, Builder] = {
    **{terrain.value: partial(drive, terrain) for terrain in Terrain},
    "placing": lambda: build_placing(TableParameters(), ArmParameters()),
    "insertion": lambda: build_insertion(InsertionParameters()),
    "room": lambda: build_room(RoomParameters(), ArmParameters(), PersonParameters()),
}


@pytest.mark.parametrize("name", SCENES)
def test_a_dressed_scene_moves_as_the_plain_one_does(name: str) -> None:
    plain = Physics(SCENES[name]())
    stage = Stage(plain.spec)
    joints = [[model.joint(index).name for index in range(model.njnt)]
              for model in (plain.model, stage.model)]  # fmt: skip
    assert joints[0] == joints[1]
    assert (stage.model.nq, stage.model.nmocap, stage.model.neq) == (
        plain.model.nq, plain.model.nmocap, plain.model.neq,
    )  # fmt: skip
    assert sum(stage.model.body_mass) == pytest.approx(sum(plain.model.body_mass))
    plain.settle(200)
    mujoco.mj_kinematics(plain.model, plain.data)
    stage.show(moment_of(plain.data))
    for index in range(plain.model.nbody):
        body = plain.model.body(index).name
        assert stage.place_of(body) == pytest.approx(plain.data.body(body).xpos, abs=1e-9)


@pytest.mark.parametrize("name", SCENES)
def test_dressing_leaves_the_plain_scene_as_it_is(name: str) -> None:
    spec = SCENES[name]()
    before = spec.compile()
    Stage(spec)
    after = spec.compile()
    assert after.ngeom == before.ngeom
    assert np.array_equal(after.geom_rgba, before.geom_rgba)
    assert np.array_equal(after.geom_contype, before.geom_contype)


@pytest.mark.parametrize("name", SCENES)
def test_nothing_that_is_only_looked_at_touches_anything(name: str) -> None:
    spec = SCENES[name]()
    plain, dressed = spec.compile(), Stage(spec).model
    touching = [int(np.count_nonzero(model.geom_contype)) for model in (plain, dressed)]
    assert touching[0] == touching[1]
    assert dressed.ngeom > plain.ngeom + 20


def test_the_fingers_open_when_the_block_is_let_go() -> None:
    built = ArmParameters()
    arm = Arm(build_placing(TableParameters(), built), built)
    stage = Stage(arm.spec)

    def width() -> float:
        left, right = (stage.place_of(name) for name in FINGERS)
        return float(np.linalg.norm(left - right))

    stage.show(moment_of(arm.data))
    closed = width()
    assert closed == pytest.approx(2 * built.block_half + 0.014, abs=0.01)
    arm.let_go()
    stage.show(moment_of(arm.data))
    assert width() == pytest.approx(closed + 0.04, abs=1e-6)
    assert not arm.data.eq_active[arm.model.equality(GRIP).id]


def test_the_links_are_drawn_where_they_are() -> None:
    built = ArmParameters()
    arm = Arm(build_placing(TableParameters(), built), built)
    model = Stage(arm.spec).model
    for link in LINKS:
        body = model.body(link.name).id
        shown = [index for index in range(model.ngeom)
                 if model.geom_bodyid[index] == body and model.geom_group[index] == 2]  # fmt: skip
        assert shown, link.name
        ends = [float(np.linalg.norm(model.geom_pos[index])) for index in shown]
        assert max(ends) <= float(np.linalg.norm(link.end)) + 0.1


def test_it_is_known_where_all_parts_are() -> None:
    plain = Physics(drive(Terrain.FLAT))
    stage = Stage(plain.spec)
    stage.show(moment_of(plain.data))
    before = stage.places()
    plain.data.qpos[0] += 0.01
    stage.show(moment_of(plain.data))
    moved = np.abs(stage.places() - before).max(axis=1)
    assert moved.max() == pytest.approx(0.01)
    assert moved.min() == 0.0, "the floor stays"


@pytest.mark.parametrize("peg", [(-0.6, 0.0, 0.7), (-0.2, -0.5, 1.0), (-0.85, 0.5, 1.25)])
def test_the_arm_reaches_for_the_hand_that_holds_the_peg(peg: tuple[float, ...]) -> None:
    plain = Physics(SCENES["insertion"]())
    stage = Stage(plain.spec)
    plain.data.qpos[:3] = peg
    stage.show(moment_of(plain.data))
    assert stage.place_of("holder_wrist") == pytest.approx([*peg[:2], peg[2] + 0.36])
    turn = stage.data.body("holder_wrist").xmat.reshape(3, 3)
    assert turn[:, 2] == pytest.approx([0, 0, -1]), "it points downwards"


def test_an_arm_that_cannot_reach_its_hand_points_at_it() -> None:
    plain = Physics(SCENES["insertion"]())
    stage = Stage(plain.spec)
    plain.data.qpos[:3] = (5.0, 0.02, 0.64)
    stage.show(moment_of(plain.data))
    foot = stage.place_of("holder_shoulder")
    assert stage.place_of("holder_wrist") - foot == pytest.approx([1.3, 0, 0])


def test_the_volumes_that_are_shown_are_those_of_the_rules() -> None:
    """The rules name only the bounds that they keep: v2 has no right one there."""
    text = (FOLDER / "insertion.ross").read_text(encoding="utf-8")
    numbers = dict(re.findall(r"const (v[12]_\w+) = (\S+) m;", text))
    shown = {
        "v1_left": V1[0][0],
        "v1_right": V1[1][0],
        "v1_front": V1[0][1],
        "v1_back": V1[1][1],
        "v1_top": V1[1][2],
        "v2_left": V2[0][0],
        "v2_front": V2[0][1],
    }
    assert {name: float(number) for name, number in numbers.items()} == shown
    found = re.search(r"const v3 = \[(.*)\] m;", text)
    assert found is not None
    corners = [pair for both in zip(*V3, strict=True) for pair in both]
    assert [float(number) for number in found[1].split(",")] == corners
