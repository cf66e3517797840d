"""Orientations with a given angle. The angle that rules compute from the orientation is exact if an
orientation of doubles with this angle exists.
"""

from __future__ import annotations

import math
from functools import lru_cache

from rossmarie.core import Function
from rossmarie.interpreter import arithmetic

Orientation = tuple[float, float, float, float]
"""x, y, z, w."""

UPRIGHT: Orientation = (0.0, 0.0, 0.0, 1.0)
ANGLES = {"roll": Function.ROLL, "pitch": Function.PITCH, "yaw": Function.YAW}
_REACH = 24  # the most ulps by which a component is moved


@lru_cache(maxsize=4096)
def with_angle(current: Orientation, angle: str, value: float) -> Orientation:
    """An orientation whose `angle` (roll, pitch or yaw, in rad) is `value`. The other angles are
    those of `current`. An unknown current angle counts as zero.
    """
    angles = {name: _known(arithmetic.apply(of, current)) for name, of in ANGLES.items()}
    angles[angle] = value
    return _refined(_composed(**angles), angle, value)


def _known(angle: float) -> float:
    return angle if math.isfinite(angle) else 0.0


def _composed(roll: float, pitch: float, yaw: float) -> Orientation:
    sr, cr = math.sin(roll / 2), math.cos(roll / 2)
    sp, cp = math.sin(pitch / 2), math.cos(pitch / 2)
    sy, cy = math.sin(yaw / 2), math.cos(yaw / 2)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def _refined(near: Orientation, angle: str, value: float) -> Orientation:
    """The orientation nearest to `near`, by ulps of two components, whose computed angle is exactly
    `value`; `near` if there is none.
    """
    moved = {"roll": 0, "pitch": 1, "yaw": 2}[angle]
    for reach in range(_REACH):
        for steps in {(reach, other) for other in range(-reach, reach + 1)} | {
            (other, reach) for other in range(-reach, reach + 1)
        }:
            for sign in (1, -1):
                candidate = list(near)
                candidate[moved] = _ulps(near[moved], sign * steps[0])
                candidate[3] = _ulps(near[3], sign * steps[1])
                found = (candidate[0], candidate[1], candidate[2], candidate[3])
                if arithmetic.apply(ANGLES[angle], found) == value:
                    return found
    return near


def _ulps(number: float, count: int) -> float:
    return number + count * math.ulp(number)
