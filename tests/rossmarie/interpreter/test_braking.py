"""S83 and S84: the way on which a speed is braked, and the time until something is reached."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rossmarie.core import Function
from rossmarie.interpreter.arithmetic import apply

NAN = math.nan
GREATEST = 1.7976931348623157e308


def braking(speed: float, deceleration: float, latency: float) -> float:
    return apply(Function.BRAKING_DISTANCE, (speed, deceleration, latency))


def time_to(left: float, speed: float) -> float:
    return apply(Function.TIME_TO, (left, speed))


def test_s83_the_way_of_the_latency_and_of_the_brakes() -> None:
    assert braking(2.0, 0.5, 0.25) == 0.5 + 4.0
    assert braking(-2.0, 0.5, 0.25) == 0.5 + 4.0
    assert braking(0.0, 0.5, 0.25) == 0.0


@pytest.mark.parametrize(
    "operands",
    [(NAN, 1.0, 0.1), (1.0, NAN, 0.1), (1.0, 1.0, NAN), (1.0, 0.0, 0.1), (1.0, -1.0, 0.1),
     (1.0, 1.0, -0.1), (1e200, 1.0, 0.1)],
)  # fmt: skip
def test_s83_without_brakes_nobody_knows_the_way(operands: tuple[float, float, float]) -> None:
    assert math.isnan(braking(*operands))


def test_s84_the_time_that_is_left() -> None:
    assert time_to(3.0, 1.5) == 2.0


def test_s84_what_does_not_come_closer_takes_the_longest_time() -> None:
    for speed in (0.0, -0.0, -1.0, -GREATEST, 5e-324):
        assert time_to(3.0, speed) == 1e9


def test_s84_what_is_there_takes_no_time() -> None:
    for speed in (-1.0, 0.0, 1.0):
        assert time_to(0.0, speed) == 0.0
        assert time_to(-0.5, speed) == 0.0


def test_s84_of_what_is_unknown_the_time_is() -> None:
    assert math.isnan(time_to(NAN, -1.0))
    assert math.isnan(time_to(1.0, NAN))
    assert math.isnan(time_to(-1.0, NAN))


NUMBERS = st.floats(allow_nan=False, allow_infinity=False)


@given(NUMBERS, NUMBERS, NUMBERS)
def test_s84_it_is_less_for_what_is_nearer_or_faster(
    one: float, other: float, third: float
) -> None:
    nearer, farther = sorted((one, other))
    assert time_to(nearer, third) <= time_to(farther, third)
    if third > 0.0:
        assert time_to(third, farther) <= time_to(third, nearer)
