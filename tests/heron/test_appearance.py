"""The look of scenes: the physics knows nothing of it."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

import mujoco

from heron.appearance import Stage, moment_of
from heron.appearance.robot import FINGERS
from heron.robot import Arm
from heron.robot.physics import Physics
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
from heron.variants import Terrain

Builder = Callable[[], Any]


def drive(terrain: Terrain) -> Any:
    return build_navigation(course(terrain, CourseParameters()), BaseParameters())


SCENES: dict[str, Builder] = {
    **{terrain.value: partial(drive, terrain) for terrain in Terrain},
    "placing": lambda: build_placing(TableParameters(), ArmParameters()),
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
