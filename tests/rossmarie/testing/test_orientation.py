"""Orientations with a wanted angle."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rossmarie.interpreter import arithmetic
from rossmarie.testing.orientation import ANGLES, UPRIGHT, with_angle
from support.depth import examples


def angle(name: str, orientation: tuple[float, float, float, float]) -> float:
    return arithmetic.apply(ANGLES[name], orientation)


@settings(max_examples=examples(2))
@given(
    st.sampled_from(sorted(ANGLES)),
    st.floats(-1.3, 1.3).map(lambda number: round(number, 4)),
)
def test_an_angle_is_the_wanted_one_up_to_the_last_bits(name: str, value: float) -> None:
    found = angle(name, with_angle(UPRIGHT, name, value))
    assert math.isclose(found, value, rel_tol=1e-15, abs_tol=1e-16)


@pytest.mark.parametrize(
    "degrees", [-20, -10, 0, 3, 5, 6, 7, 8, 10, 11, 12, 15, 16, 18, 20, 21, 30]
)
def test_usual_thresholds_are_exact(degrees: float) -> None:
    value = degrees * (math.pi / 180)
    assert angle("pitch", with_angle(UPRIGHT, "pitch", value)) == value


def test_the_other_angles_stay() -> None:
    orientation = with_angle(UPRIGHT, "yaw", 1.0)
    orientation = with_angle(orientation, "roll", -0.3)
    orientation = with_angle(orientation, "pitch", 0.2)
    found = [angle(name, orientation) for name in ("roll", "pitch", "yaw")]
    assert found == pytest.approx([-0.3, 0.2, 1.0], abs=1e-9)


def test_of_an_unknown_orientation_the_others_are_zero() -> None:
    unknown = (math.nan, 0.0, 0.0, 1.0)
    assert with_angle(unknown, "pitch", 0.2) == with_angle(UPRIGHT, "pitch", 0.2)
