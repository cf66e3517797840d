"""Distances and times of motions: `braking_distance` and `time_to` (S83, S84)."""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie.core.expressions import (
    UNKNOWN,
    Condition,
    Either,
    Expression,
    IsUnknown,
    choose,
)

LONGEST_TIME = 1e9
"""The greatest result of `time_to` in seconds. It stands for "never"."""


def braking_distance(v: Expression, a: Expression, t: Expression) -> Expression:
    """S83: the braking distance for a speed `v`, a deceleration `a` and a latency `t`."""
    distance = abs(v) * t + (v * v) / a / 2.0
    return choose(a > 0.0, choose(t < 0.0, UNKNOWN, distance), UNKNOWN)


def time_to(left: Expression, speed: Expression) -> Expression:
    """S84: the time until an object arrives. If the object does not come closer, the result is the
    longest time. If the object has arrived, the result is 0.
    """
    time = left / speed
    running = choose(time < LONGEST_TIME, time, LONGEST_TIME)
    coming = choose(left > 0.0, choose(speed > 0.0, running, LONGEST_TIME), 0.0)
    return choose(Either(IsUnknown(left), IsUnknown(speed)), UNKNOWN, coming)


# --- facts for solvers -------------------------------------------------------------------

_SLACK = 2.0**-40
"""A margin above the rounding errors."""
_TINY = 2.0**-500
"""The number below which products and quotients underflow."""


def bounds_of_braking(result: Expression, operands: Sequence[Expression]) -> tuple[Condition, ...]:
    """Bounds: the formula without its division, except for rounding; empty if no distance is
    known.
    """
    v, a, t = operands
    whole = abs(v) * t * (2.0 * a) + v * v
    lost = (a + 1.0) * _TINY
    found = result * (2.0 * a)
    bounds = (whole * (1.0 - _SLACK) - lost < found, found < whole * (1.0 + _SLACK) + lost)
    return tuple(Either(_is_at_most_zero(a), Either(t < 0.0, each)) for each in bounds)


def bounds_of_time(result: Expression, operands: Sequence[Expression]) -> tuple[Condition, ...]:
    """Bounds: the formula without its division, except for rounding."""
    left, speed = operands
    lost = (abs(speed) + 1.0) * _TINY
    run = result * speed
    is_there, is_never = _is_at_most_zero(left), result.equals(LONGEST_TIME)
    no_more = run < left * (1.0 + _SLACK) + lost
    no_less = Either(is_never, left * (1.0 - _SLACK) - lost < run)
    return (
        Either(left > 0.0, result.equals(0.0)),
        Either(is_there, Either(speed > 0.0, is_never)),
        Either(is_there, no_more),
        Either(is_there, Either(_is_at_most_zero(speed), no_less)),
    )


def _is_at_most_zero(number: Expression) -> Condition:
    return Either(number < 0.0, number.equals(0.0))
