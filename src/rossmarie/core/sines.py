"""Sine and cosine, composed of sums, products and differences: rule S69.

Each operation is rounded as IEEE 754 specifies, and no operation uses bit patterns. So results are
equal to the last bit wherever numbers are binary64. `tests/rossmarie/core/test_sines.py` measures
the error.

The method is that of Sun's `k_sin.c`, `k_cos.c` and `e_rem_pio2.c` (fdlibm). It subtracts whole
right angles, so that the remaining angle is near zero, where a polynomial is accurate. For this
subtraction, the right angle is split into three numbers, which together have more digits than one
number. The coefficients interpolate the functions at Chebyshev nodes; the same test derives them.
"""

from __future__ import annotations

from rossmarie.core.angles import polynomial
from rossmarie.core.expressions import (
    UNKNOWN,
    Either,
    Expression,
    Local,
    Operand,
    Subfunction,
    choose,
)

LARGEST = 1e6
"""The largest angle in radians with a result. Beyond it, the three parts have too few digits."""

RIGHT_ANGLES = 0.6366197723675814
"""The number of right angles in a radian."""

FIRST, SECOND, THIRD = 1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21
"""The parts of a right angle: 33 bits, so that some hundred thousand multiples are exact; the next
33 bits; and the remainder.
"""

ROUNDING = 1.5 * 2.0**52
"""The addition and subtraction of this number rounds a number to a whole number."""

SINE_TERMS = (
    -0.16666666666666666,
    0.008333333333330948,
    -0.00019841269836758574,
    2.755731610255244e-06,
    -2.5051131845003624e-08,
    1.5918129294866608e-10,
)
"""Terms of `(sin(x) / x - 1) / z` in `z = x * x`, for x up to half a right angle."""

COSINE_TERMS = (
    0.041666666666666664,
    -0.0013888888888887398,
    2.480158729876569e-05,
    -2.7557317271729793e-07,
    2.08761462684032e-09,
    -1.1382632425521717e-11,
)
"""Terms of `(cos(x) - 1 + z / 2) / (z * z)` in `z = x * x`, for x up to half a right angle."""


def _near_sine(x: Expression, rest: Expression) -> Expression:
    z = Local("z", x * x)
    bend = rest - 0.5 * z * rest
    return x + (bend + x * polynomial(SINE_TERMS, z))


def _near_cosine(x: Expression, rest: Expression) -> Expression:
    z = Local("z", x * x)
    half = Local("half", 0.5 * z)
    upper = Local("upper", 1.0 - half)
    return upper + (((1.0 - upper) - half) + (z * polynomial(COSINE_TERMS, z) - x * rest))


_NEAR_SINE = Subfunction(
    "sine_near", ("x", "rest"), _near_sine(Operand(0), Operand(1)), "the sine of {0} + {1}"
)
_NEAR_COSINE = Subfunction(
    "cosine_near", ("x", "rest"), _near_cosine(Operand(0), Operand(1)), "the cosine of {0} + {1}"
)


def _whole(x: Expression) -> Expression:
    """The nearest whole number to a number of moderate size."""
    return (x + ROUNDING) - ROUNDING


def _turned(x: Expression, ahead: int) -> Expression:
    """The sine of an angle plus `ahead` right angles."""
    turns = Local("turns", _whole(x * RIGHT_ANGLES))
    begun = Local("begun", x - turns * FIRST)
    taken = Local("taken", turns * SECOND)
    left = Local("left", begun - taken)
    back = Local("back", begun - left)  # the rounding error of the difference, after Knuth
    lost = (begun - (left + back)) + (back - taken)
    rest = Local("rest", lost - turns * THIRD)
    place = Local("place", turns + float(ahead))
    quarter = Local("quarter", place - 4.0 * _whole(place * 0.25))  # from -2 to 2
    is_odd = abs(quarter).equals(1.0)
    wave = Local("wave", choose(is_odd, _NEAR_COSINE(left, rest), _NEAR_SINE(left, rest)))
    is_below = Either(quarter.equals(-1.0), abs(quarter).equals(2.0))
    return choose(abs(x) < LARGEST, choose(is_below, -wave, wave), UNKNOWN)


def sine(angle: Expression) -> Expression:
    """S69: the sine of an angle in radians."""
    return _turned(angle, 0)


def cosine(angle: Expression) -> Expression:
    """S69: the cosine of an angle in radians."""
    return _turned(angle, 1)
