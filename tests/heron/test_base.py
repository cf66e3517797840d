"""The base on ramps: what its torque is enough for."""

from __future__ import annotations

import math

import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron.robot import Base
from heron.robot.physics import attitude
from heron.scene import BaseParameters, CourseParameters, build_navigation, course
from heron.scene.ground import Contact, ramp_pieces, run_of
from heron.variants import Terrain


def driven(terrain: Terrain, torque: float, seconds: float) -> Base:
    """The base, right before the ramp of a course, told to drive on at 0.4 m/s."""
    base = BaseParameters()
    built = course(terrain, CourseParameters())
    physics = Base(build_navigation(built, base))
    physics.data.qpos[0] = built.slopes[0].start_x - 0.6
    physics.settle(200)
    physics.limit_torque(torque)
    physics.turn_wheels(0.4 / base.wheel_radius, 0.4 / base.wheel_radius)
    physics.settle(round(seconds / 0.002))
    return physics


def tilt(physics: Base) -> float:
    return abs(math.degrees(attitude(physics.quaternion).pitch))


def test_a_gentle_ramp_is_too_much_for_the_torque_that_the_level_needs() -> None:
    base = BaseParameters()
    stalled = driven(Terrain.GENTLE, base.torque, 20)
    assert stalled.position[0] < 8.0
    assert tilt(stalled) > 10
    assert stalled.torque == pytest.approx(base.torque)
    boosted = driven(Terrain.GENTLE, base.boosted_torque, 20)
    assert boosted.position[0] > 10.0
    assert boosted.position[2] == pytest.approx(0.8, abs=0.01)


def test_a_steep_ramp_stops_the_base_in_its_toe() -> None:
    stalled = driven(Terrain.STEEP, BaseParameters().torque, 8)
    assert stalled.position[0] < 8.2
    assert 5 < tilt(stalled) < 16


def test_the_base_stands_still_and_upright() -> None:
    physics = Base(build_navigation(course(Terrain.FLAT, CourseParameters()), BaseParameters()))
    physics.settle(1000)
    assert physics.position == pytest.approx([0.0, 0.0, 0.0], abs=0.002)
    assert tilt(physics) < 0.1
    assert physics.sensor("acceleration") == pytest.approx([0.0, 0.0, 9.81], abs=0.05)


def test_it_weighs_what_the_robot_weighs() -> None:
    base = BaseParameters()
    model = build_navigation(course(Terrain.FLAT, CourseParameters()), base).compile()
    assert sum(model.body_mass) == pytest.approx(99.0)
    assert base.mass == pytest.approx(99.0)


def test_a_ramp_ends_at_its_height() -> None:
    pieces = ramp_pieces(math.radians(12), 0.8, 0.3, 3)
    assert sum(one.length * math.sin(one.slope) for one in pieces) == pytest.approx(0.8)
    assert run_of(pieces) < sum(one.length for one in pieces)
    with pytest.raises(ValueError, match="before the top"):
        ramp_pieces(math.radians(25), 0.2, 0.3, 3)
    assert Contact().friction == 1.0
