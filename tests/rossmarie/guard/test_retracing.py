"""A guard asks for the poses that rules send back: the same in C and in Python."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from rossmarie.guard import Guard
from rossmarie.ir import TaskCommandKind
from support.c_compiler import needs_c
from support.drafts import SECOND
from support.engines import load

RULES = """
input tip = topic /tip : geometry_msgs/Pose timeout 0.5 sec;
action back {
    retrace tip on /target : geometry_msgs/PoseStamped { header.frame_id = "base"; }
        up to 3 apart 15 cm at 5 Hz;
}
action slow { limit /speed : geometry_msgs/Twist { linear.x in [-0.1, 0.1] m/s; }; }
rule outside: if tip.position.x > 0.75 m then { slow; back; } feedback margin in cm;
"""
TURN = (0.0, 0.0, 0.0, 1.0)


@pytest.fixture(params=[pytest.param("native", marks=needs_c), "python"])
def guard(request: pytest.FixtureRequest, tmp_path: Path) -> Guard:
    places = {f"position.{axis}": place for place, axis in enumerate("xyz")}
    turns = {f"orientation.{axis}": place for place, axis in enumerate("xyzw", start=3)}
    observe = {f"tip.{name}": place for name, place in (places | turns).items()}
    others = ("linear.y", "linear.z", "angular.x", "angular.y", "angular.z")
    monitor = load(RULES, request.param, tmp_path)
    if request.param == "native":
        return monitor.guard(observe=observe, act={"linear.x": 0, **dict.fromkeys(others)})
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("CC", "no-such-compiler")
        with pytest.warns(RuntimeWarning, match="no-such-compiler"):
            return monitor.guard(observe=observe, act={"linear.x": 0, **dict.fromkeys(others)})


def poses(guard: Guard, at_s: float, x: float) -> list[tuple[float, ...]]:
    """The poses that are asked for in a step."""
    seen = np.array([x, 0.0, 0.5, *TURN])
    decision = guard.step(round(at_s * SECOND), seen, np.array([0.4]))
    asked = [each for each in decision.requests if each.kind is TaskCommandKind.RETRACE]
    assert all(each.rule == "outside" for each in asked)
    return [each.pose for each in asked]


def test_poses_of_steps_in_which_nothing_changed_are_sent_back(guard: Guard) -> None:
    for step in range(8):
        assert poses(guard, 0.1 * step, 0.1 * step) == []
    assert poses(guard, 0.8, 0.8) == [(0.6000000000000001, 0.0, 0.5, *TURN)]
    assert poses(guard, 0.9, 0.8) == []
    assert poses(guard, 1.0, 0.8) == [(0.4, 0.0, 0.5, *TURN)]
    assert poses(guard, 1.1, 0.8) == []
    assert poses(guard, 1.4, 0.8) == [(0.2, 0.0, 0.5, *TURN)]
    assert poses(guard, 1.6, 0.8) == []


def test_a_saved_guard_has_its_memory(guard: Guard) -> None:
    for step in range(8):
        poses(guard, 0.1 * step, 0.1 * step)
    saved = guard.state()
    first = poses(guard, 0.8, 0.8)
    guard.restore(saved)
    assert poses(guard, 0.8, 0.8) == first != []
    guard.restart()
    assert poses(guard, 0.8, 0.8) == []


def test_margins_are_reported_beside_what_memories_ask(guard: Guard) -> None:
    poses(guard, 0.0, 0.5)
    decision = guard.step(round(0.1 * SECOND), np.array([0.5, 0.0, 0.5, *TURN]), np.array([0.4]))
    assert decision.margin.tolist() == pytest.approx([25.0])


def test_nothing_is_sent_while_nobody_knows_where_the_robot_is(guard: Guard) -> None:
    for step in range(8):
        poses(guard, 0.1 * step, 0.1 * step)
    assert poses(guard, 0.8, float("nan")) == []
    assert len(poses(guard, 0.9, 0.8)) == 1
