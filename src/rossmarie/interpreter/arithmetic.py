"""Functions of numbers (rules S3 to S6), as IEEE 754 has them.

Python's floats are IEEE binary64 and round as C's doubles do; only division by zero raises, where
C gives an infinity or NaN. Both become NaN in the end (S4), so this file returns NaN at once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from rossmarie.ir.model import Function

NAN = math.nan


def apply(function: Function, operands: tuple[float, ...]) -> float:
    """The value of a function; NaN if it is not finite (S4)."""
    return finite_or_nan(_FUNCTIONS[function](*operands))


def finite_or_nan(value: float) -> float:
    """Not finite is not known (S4)."""
    return value if math.isfinite(value) else NAN


def minimum(a: float, b: float) -> float:
    """The lesser of two, NaN if either is; of two equal ones the second (S6)."""
    if math.isnan(a) or math.isnan(b):
        return NAN
    if a < b:
        return a
    return b


def maximum(a: float, b: float) -> float:
    """The greater of two, NaN if either is; of two equal ones the second (S6)."""
    if math.isnan(a) or math.isnan(b):
        return NAN
    if a > b:
        return a
    return b


def _divide(a: float, b: float) -> float:
    return NAN if b == 0.0 else a / b


def _norm(*components: float) -> float:
    total = components[0] * components[0]
    for component in components[1:]:
        total = total + component * component
    return math.sqrt(total)


def _square_length(x: float, y: float, z: float, w: float) -> float:
    return ((x * x + y * y) + z * z) + w * w


def _roll(x: float, y: float, z: float, w: float) -> float:
    n = _square_length(x, y, z, w)
    if n == 0.0:
        return NAN
    sine = (2.0 * (w * x + y * z)) / n
    cosine = 1.0 - (2.0 * (x * x + y * y)) / n
    return math.atan2(sine, cosine)


def _pitch(x: float, y: float, z: float, w: float) -> float:
    n = _square_length(x, y, z, w)
    if n == 0.0:
        return NAN
    sine = (2.0 * (w * y - z * x)) / n
    # Rounding may leave the range of a sine by an ulp, where asin has no value.
    return math.asin(_clamp(sine))


def _clamp(sine: float) -> float:
    if sine < -1.0:
        return -1.0
    if sine > 1.0:
        return 1.0
    return sine


def _yaw(x: float, y: float, z: float, w: float) -> float:
    n = _square_length(x, y, z, w)
    if n == 0.0:
        return NAN
    sine = (2.0 * (w * z + x * y)) / n
    cosine = 1.0 - (2.0 * (y * y + z * z)) / n
    return math.atan2(sine, cosine)


_FUNCTIONS: Mapping[Function, Callable[..., float]] = {
    Function.ADD: lambda a, b: a + b,
    Function.SUBTRACT: lambda a, b: a - b,
    Function.MULTIPLY: lambda a, b: a * b,
    Function.DIVIDE: _divide,
    Function.NEGATE: lambda a: -a,
    Function.ABSOLUTE: abs,
    Function.MINIMUM: minimum,
    Function.MAXIMUM: maximum,
    Function.NORM: _norm,
    Function.ROLL: _roll,
    Function.PITCH: _pitch,
    Function.YAW: _yaw,
}
