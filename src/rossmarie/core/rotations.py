"""Rotations by quaternions: a rotated vector, and the composition of two rotations (S76).

The length of a quaternion does not matter. However, a quaternion that is far too short or too long
is not a measurement.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from rossmarie.core.expressions import (
    UNKNOWN,
    Condition,
    Either,
    Expression,
    Local,
    choose,
)
from rossmarie.core.regions import Easy

_SHORTEST = 2.0**-500
_LONGEST = 2.0**500
"""The limits of the squared length. Within these limits no square underflows or overflows."""

_SLACK = 2.0**-40
"""A margin above the rounding errors in a rotation."""


class _Turn(NamedTuple):
    """The components of a quaternion, and its squared length."""

    x: Expression
    y: Expression
    z: Expression
    w: Expression
    n: Expression


def turned_x(*operands: Expression) -> Expression:
    """The x of a vector (three operands) that is rotated by a quaternion (four operands)."""
    return _turned(
        operands,
        lambda q: (
            1.0 - 2.0 * (q.y * q.y + q.z * q.z) / q.n,
            2.0 * (q.x * q.y - q.w * q.z) / q.n,
            2.0 * (q.x * q.z + q.w * q.y) / q.n,
        ),
    )


def turned_y(*operands: Expression) -> Expression:
    """The y of the rotated vector."""
    return _turned(
        operands,
        lambda q: (
            2.0 * (q.x * q.y + q.w * q.z) / q.n,
            1.0 - 2.0 * (q.x * q.x + q.z * q.z) / q.n,
            2.0 * (q.y * q.z - q.w * q.x) / q.n,
        ),
    )


def turned_z(*operands: Expression) -> Expression:
    """The z of the rotated vector."""
    return _turned(
        operands,
        lambda q: (
            2.0 * (q.x * q.z - q.w * q.y) / q.n,
            2.0 * (q.y * q.z + q.w * q.x) / q.n,
            1.0 - 2.0 * (q.x * q.x + q.y * q.y) / q.n,
        ),
    )


_Row = Callable[[_Turn], tuple[Expression, Expression, Expression]]


def _turned(operands: Sequence[Expression], row: _Row) -> Expression:
    """One row of a rotation matrix, times a vector."""
    a, b, c, x, y, z, w = operands
    n = Local("n", ((x * x + y * y) + z * z) + w * w)
    first, second, third = row(_Turn(x, y, z, w, n))
    result = (first * a + second * b) + third * c
    return choose(Either(n < _SHORTEST, n > _LONGEST), UNKNOWN, result)


def bounds_of_turned(result: Expression, operands: Sequence[Expression]) -> tuple[Condition, ...]:
    """Bounds: a rotated component is at most the sum of the components' absolute values."""
    a, b, c = map(abs, operands[:3])
    most = ((a + b) + c) * (1.0 + _SLACK) + 2.0 * _SHORTEST
    return (abs(result) < most,)


def easy_turned(component: int) -> Callable[[Sequence[Expression]], tuple[Easy, ...]]:
    """Easy case: the identity leaves a component unchanged."""
    return lambda operands: (Easy(_is_upright(operands[3:]), operands[component]),)


# --- composition -----------------------------------------------------------------------------


def composed_x(*operands: Expression) -> Expression:
    """The x of the product of two quaternions with four operands each: the second rotation, and the
    first one.
    """
    px, py, pz, pw, qx, qy, qz, qw = operands
    return ((pw * qx + px * qw) + py * qz) - pz * qy


def composed_y(*operands: Expression) -> Expression:
    """The y of the product of two quaternions."""
    px, py, pz, pw, qx, qy, qz, qw = operands
    return ((pw * qy - px * qz) + py * qw) + pz * qx


def composed_z(*operands: Expression) -> Expression:
    """The z of the product of two quaternions."""
    px, py, pz, pw, qx, qy, qz, qw = operands
    return ((pw * qz + px * qy) - py * qx) + pz * qw


def composed_w(*operands: Expression) -> Expression:
    """The w of the product of two quaternions."""
    px, py, pz, pw, qx, qy, qz, qw = operands
    return ((pw * qw - px * qx) - py * qy) - pz * qz


def easy_composed(component: int) -> Callable[[Sequence[Expression]], tuple[Easy, ...]]:
    """Easy case: the identity, before or after another rotation, leaves that rotation unchanged."""
    return lambda operands: (
        Easy(_is_upright(operands[:4]), operands[4 + component]),
        Easy(_is_upright(operands[4:]), operands[component]),
    )


def _is_upright(turn: Sequence[Expression]) -> tuple[Condition, ...]:
    x, y, z, w = turn
    return x.equals(0.0), y.equals(0.0), z.equals(0.0), w.equals(1.0)
