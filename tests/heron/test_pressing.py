"""Motions whose contact is meant: how hard they press, where they end, and that they leave."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron.robot.physics import Floats
from heron.robot.pressing import Pressing, PushMotion, PushParameters, WipeMotion, WipeParameters

STEP = 0.008
ALONG = np.array([0.0, -1.0, 0.0])
END = np.array([0.0, -0.2, 0.0])
ROWS = [np.array([0.0, -0.1, 0.9]), np.array([0.2, -0.1, 0.9]), np.array([0.2, -0.1, 0.8])]
FACE = 0.1
SPRING = 10_000.0  # N/m, of what is touched


def played(
    motion: Pressing, start: Floats, felt: Callable[[Floats], Floats], seconds: float = 30.0
) -> list[tuple[Floats, Floats]]:
    """Places and forces, with servos that are there at once, until it is over."""
    found: list[tuple[Floats, Floats]] = []
    place = start
    motion.begin(start)
    while not motion.is_over and len(found) * STEP < seconds:
        force = felt(place)
        place = motion.step(place, force, STEP, 1.0)
        found.append((place, force))
    return found


def in_the_air(_: Floats) -> Floats:
    return np.zeros(3)


def against(face: float) -> Callable[[Floats], Floats]:
    """A wall across the way."""
    return lambda place: -ALONG * SPRING * max(0.0, float(place @ ALONG) - face)


def test_a_push_ends_at_its_end_and_leaves_what_it_has_pushed() -> None:
    motion = PushMotion(END, PushParameters())
    path = played(motion, np.zeros(3), lambda _: -ALONG * 20.0)
    assert motion.is_over
    furthest = max(float(place @ ALONG) for place, _ in path)
    assert furthest == pytest.approx(0.2, abs=0.003)
    assert float(path[-1][0] @ ALONG) == pytest.approx(0.2 - 0.025, abs=0.004)
    assert np.ptp([place[0] for place, _ in path]) == 0.0


def test_a_push_is_slow_until_it_touches_something_and_then_as_fast_as_it_is_said_to_be() -> None:
    parameters = PushParameters(speed=0.04, approach=0.02)
    gently = played(PushMotion(END, parameters), np.zeros(3), in_the_air, 2.0)
    assert float(gently[-1][0] @ ALONG) == pytest.approx(0.04, abs=0.003)
    touching = played(PushMotion(END, parameters), np.zeros(3), lambda _: -ALONG * 4.0, 5.0)
    speeds = np.diff([float(place @ ALONG) for place, _ in touching]) / STEP
    assert speeds[-1] == pytest.approx(0.04, abs=0.003)


def test_a_push_against_what_does_not_give_way_is_never_harder_than_it_may_be() -> None:
    motion = PushMotion(END, PushParameters(most=50.0))
    path = played(motion, np.zeros(3), against(0.1))
    assert not motion.is_over
    forces = [float(np.linalg.norm(force)) for _, force in path]
    assert forces[-1] == pytest.approx(50.0, abs=1.0)
    assert max(forces) < 55.0


def test_a_push_begins_anew_from_where_the_hand_is() -> None:
    motion = PushMotion(END, PushParameters())
    played(motion, np.zeros(3), in_the_air, 1.0)
    path = played(motion, np.array([0.01, -0.05, 0.0]), in_the_air)
    assert motion.is_over
    assert path[0][0] == pytest.approx([0.01, -0.05, 0.0], abs=0.001)


def test_a_wipe_presses_as_hard_as_it_is_said_to_and_goes_all_the_way() -> None:
    motion = WipeMotion(ROWS, ALONG, WipeParameters(press=19.0))
    path = played(motion, np.array([0.0, -0.09, 0.9]), against(FACE))
    assert motion.is_over
    stroking = [force for place, force in path if 0.05 < place[0] < 0.15]
    assert np.median(np.linalg.norm(stroking, axis=1)) == pytest.approx(19.0, abs=1.0)
    for corner in ROWS:
        assert min(np.linalg.norm((place - corner)[[0, 2]]) for place, _ in path) < 0.002
    assert float(path[-1][0] @ ALONG) < FACE - 0.02, "it has left the board"


def test_a_wipe_that_touches_nothing_strokes_nothing() -> None:
    motion = WipeMotion(ROWS, ALONG, WipeParameters())
    path = played(motion, np.array([0.0, -0.09, 0.9]), in_the_air, 5.0)
    assert not motion.is_over
    assert np.ptp([place[0] for place, _ in path]) == 0.0


@pytest.mark.parametrize("pace", [0.0, 0.5])
def test_its_pace_can_be_scaled(pace: float) -> None:
    motion = PushMotion(END, PushParameters())
    motion.begin(np.zeros(3))
    place = np.zeros(3)
    for _ in range(125):
        place = motion.step(place, np.zeros(3), STEP, pace)
    assert float(place @ ALONG) == pytest.approx(0.015 * pace, abs=0.002)
