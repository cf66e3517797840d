"""Arc sine and arc tangent, composed of sums, products, quotients and roots: rule S5.

Each operation is rounded as IEEE 754 specifies, and no operation uses bit patterns. So angles are
equal to the last bit wherever numbers are binary64. Both functions stay within one unit in the last
place (ulp) of the exact angle; `tests/rossmarie/core/test_angles.py` measures the error.

The method is that of Sun's `e_asin.c` and `s_atan.c` (fdlibm). It reduces the operand to a range
near zero, where a polynomial is accurate, and keeps the rounding error of the larger numbers as a
separate number. The coefficients interpolate the functions at Chebyshev nodes; the same test
derives them. Each angle below is a double, followed by its difference to the exact angle.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce

from rossmarie.core.expressions import (
    ConstantNumber,
    Either,
    Expression,
    Local,
    Operand,
    Subfunction,
    Written,
    choose,
    square_root,
    written,
)

HALF_TURN, HALF_TURN_REST = 3.141592653589793, 1.2246467991473532e-16
RIGHT_ANGLE, RIGHT_ANGLE_REST = 1.5707963267948966, 6.123233995736766e-17
DIAGONAL, DIAGONAL_REST = 0.7853981633974483, 3.061616997868383e-17
OF_A_HALF, OF_A_HALF_REST = 0.4636476090008061, 2.2698777452961687e-17

NEAR_SINE = 0.5
"""The largest sine to which the polynomial is applied directly."""

SINE_TERMS = (
    0.16666666666666669,
    0.07499999999998433,
    0.04464285714635543,
    0.030381944138531247,
    0.02237217294214989,
    0.017352392720869973,
    0.013971212973552933,
    0.011479177415184906,
    0.01032281435018578,
    0.005457506718640358,
    0.01740087944269402,
    -0.014851887071247204,
    0.028757851367421566,
)
"""Terms of `(asin(x) / x - 1) / z` in `z = x * x`, for `z` up to 1/4."""

NEAR_TANGENT, MIDDLE_TANGENT = 0.4375, 0.6875
"""The polynomial is applied to a tangent up to the first limit directly, up to the second limit to
its difference from 1/2, and up to 1 to its difference from 1.
"""

TANGENT_TERMS = (
    -0.3333333333333333,
    0.1999999999999941,
    -0.14285714285566806,
    0.11111111096645038,
    -0.09090908355602592,
    0.07692285554889286,
    -0.06666241923359964,
    0.05876946456755061,
    -0.05216679739313656,
    0.04492259293193656,
    -0.033128134256069586,
    0.014773184616983806,
)
"""Terms of `(atan(x) / x - 1) / z` in `z = x * x`, for `z` up to the square of 0.4375."""

_TINY = 2.0**-27
"""The square of a tangent below this adds nothing to 1."""


def polynomial(terms: Sequence[float], z: Expression) -> Expression:
    """The sum of terms times powers of `z`, from the first power on. Groups of three terms are
    independent, so that processors can compute them in parallel.
    """
    cube = Local("cube", z * z * z)
    parts = [
        Local(f"part{first // 3}", _nested(terms[first : first + 3], z))
        for first in range(0, len(terms), 3)
    ]
    return z * _nested(parts, cube)


def _nested(terms: Sequence[Written], z: Expression) -> Expression:
    """The sum of terms times powers of `z`, by Horner."""
    return reduce(lambda total, term: written(term) + z * total, map(written, reversed(terms)))


# --- digits ----------------------------------------------------------------------------------


def _leading(x: Expression) -> Expression:
    """The leading digits of a number, after Veltkamp. The product of two such numbers is exact."""
    scaled = Local("scaled", x * (2.0**27 + 1.0))
    return scaled - (scaled - x)


LEADING = Subfunction(
    "leading", ("x",), _leading(Operand(0)), "the leading half of the digits of {0}"
)

# --- arc sine --------------------------------------------------------------------------------

_SINE_SURPLUS = Subfunction(
    "arcsine_surplus",
    ("z",),
    polynomial(SINE_TERMS, Operand(0)),
    "the arc sine of x divided by x, minus 1, where {0} is x * x",
)


def _far_arc_sine(x: Expression) -> Expression:
    """The arc sine of a number near 1. The difference to a right angle is twice the arc sine of a
    number near zero.
    """
    z = Local("z", 0.5 * (1.0 - x))
    root = Local("root", square_root(z))
    upper = Local("upper", LEADING(root))
    lost = (z - upper * upper) / (root + upper)
    lower = Local("lower", choose(root.equals(0.0), 0.0, lost))
    rest = (RIGHT_ANGLE_REST - 2.0 * lower) - 2.0 * root * _SINE_SURPLUS(z)
    return (RIGHT_ANGLE - 2.0 * upper) + rest


_FAR_ARC_SINE = Subfunction(
    "arcsine_far", ("x",), _far_arc_sine(Operand(0)), "the arc sine of {0}, for {0} from 1/2 to 1"
)


def _arc_sine(x: Expression) -> Expression:
    size = Local("size", abs(x))
    far = choose(x < 0.0, -_FAR_ARC_SINE(size), _FAR_ARC_SINE(size))
    return choose(size < NEAR_SINE, x + x * _SINE_SURPLUS(x * x), far)


ARC_SINE = Subfunction(
    "arcsine",
    ("x",),
    _arc_sine(Operand(0)),
    "the arc sine of {0} in radians, NaN if {0} is outside [-1, 1]",
)

# --- arc tangent -----------------------------------------------------------------------------

_TANGENT_SURPLUS = Subfunction(
    "arctangent_surplus",
    ("z",),
    polynomial(TANGENT_TERMS, Operand(0)),
    "the arc tangent of x divided by x, minus 1, where {0} is x * x",
)


def _arc_tangent(y: Expression, x: Expression) -> Expression:
    """The angle of a point. It starts at the nearer axis, adds one of three known angles, and then
    the arc tangent of the remainder, `over / along`. The result has the sign of `y`, also of a
    zero; the sign of a zero `x` has no effect.

    The result is within one ulp for points far from the least and the greatest numbers, such as
    sines and cosines. One coordinate may be infinite; if both are, the result is NaN.
    """
    height, width = Local("height", abs(y)), Local("width", abs(x))
    is_steep = width < height
    lesser = Local("lesser", choose(is_steep, width, height))
    greater = Local("greater", choose(is_steep, height, width))

    def by_sector(near: Written, middle: Written, diagonal: Written) -> Expression:
        is_diagonal, is_middle = (
            limit * greater < lesser for limit in (MIDDLE_TANGENT, NEAR_TANGENT)
        )
        return choose(is_diagonal, diagonal, choose(is_middle, middle, near))

    over = Local("over", by_sector(lesser, lesser - 0.5 * greater, lesser - greater))
    along = Local("along", by_sector(greater, greater + 0.5 * lesser, greater + lesser))
    is_origin = (height + width).equals(0.0)
    tangent = Local("tangent", choose(is_origin, 0.0, over / along))
    upper, lower = _halves(tangent, over, along)
    surplus = Local("surplus", tangent * _TANGENT_SURPLUS(tangent * tangent))

    is_left = x < 0.0
    axis = Local("axis", choose(is_steep, RIGHT_ANGLE, choose(is_left, HALF_TURN, 0.0)))
    axis_rest = choose(is_steep, RIGHT_ANGLE_REST, choose(is_left, HALF_TURN_REST, 0.0))
    on, back = choose(is_left, -1.0, 1.0), choose(is_left, 1.0, -1.0)
    way = Local("way", choose(is_steep, back, on))
    turn = Local("turn", way * by_sector(0.0, OF_A_HALF, DIAGONAL))
    turn_rest = Local("turn_rest", way * by_sector(0.0, OF_A_HALF_REST, DIAGONAL_REST))
    start = Local("start", axis + turn)
    rest = Local("rest", ((axis - start) + turn) + (axis_rest + turn_rest))
    angle = Local("angle", start + way * (upper + (way * rest + (lower + surplus))))
    return choose(Either(y < 0.0, ConstantNumber(1.0) / y < 0.0), -angle, angle)


def _halves(quotient: Expression, over: Expression, along: Expression) -> tuple[Local, Local]:
    """A quotient as two numbers, which together have more digits than one number. For a tiny
    quotient the second number is zero, because its digits are not needed.
    """
    is_tiny = abs(quotient) < _TINY
    upper = Local("upper", choose(is_tiny, quotient, LEADING(quotient)))
    divisor = Local("divisor", LEADING(along))
    left = (over - upper * divisor) - upper * (along - divisor)
    return upper, Local("lower", choose(is_tiny, 0.0, left / along))


ARC_TANGENT = Subfunction(
    "arctangent",
    ("y", "x"),
    _arc_tangent(Operand(0), Operand(1)),
    "the angle of the point ({1}, {0}) in radians",
)
