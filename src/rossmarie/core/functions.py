"""The functions from numbers to a number, each defined once: rules S3 to S6.

A member of `Function` and its row in `FUNCTIONS` define a function completely: interpreter,
targets, solvers and the words of reports use that row. A result that is not finite is unknown (S4):
the code that applies a function turns it into NaN.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, reduce

from rossmarie.core.angles import ARC_SINE, ARC_TANGENT, HALF_TURN, RIGHT_ANGLE
from rossmarie.core.expressions import (
    UNKNOWN,
    Condition,
    Either,
    Expression,
    IsUnknown,
    Local,
    Operand,
    choose,
    square_root,
)
from rossmarie.core.motion import (
    LONGEST_TIME,
    bounds_of_braking,
    bounds_of_time,
    braking_distance,
    time_to,
)
from rossmarie.core.regions import (
    OPERANDS,
    RULES,
    Easy,
    RegionFunction,
    RegionMeasure,
    bounds,
    define,
    easy,
    phrase,
    range_of,
)
from rossmarie.core.rotations import (
    bounds_of_turned,
    composed_w,
    composed_x,
    composed_y,
    composed_z,
    easy_composed,
    easy_turned,
    turned_x,
    turned_y,
    turned_z,
)
from rossmarie.core.sines import cosine, sine


class Function(enum.Enum):
    """Functions from numbers to a number."""

    ADD = "add"
    SUBTRACT = "subtract"
    MULTIPLY = "multiply"
    DIVIDE = "divide"
    NEGATE = "negate"
    ABSOLUTE = "absolute"
    MINIMUM = "minimum"  # of two numbers
    MAXIMUM = "maximum"  # of two numbers
    ABOVE = "above"  # the third if the first is above the second, else 0
    BRAKING_DISTANCE = "braking_distance"  # of a speed, a deceleration and a latency
    TIME_TO = "time_to"  # of a remaining distance and the speed at which it shrinks
    SEEN = "seen"  # the first if the second equals the third, else unknown
    RAISED = "raised"  # the first if it is above the second, at most the third; else the second
    LOWERED = "lowered"  # the first if it is below the second, at least the third; else the second
    NORM = "norm"  # of one or more numbers
    HYPOT = "hypot"
    ROLL = "roll"  # of a quaternion x, y, z, w of any nonzero length
    PITCH = "pitch"
    YAW = "yaw"
    SINE = "sine"  # of an angle
    COSINE = "cosine"
    TURNED_X = "turned_x"  # of a vector x, y, z and the quaternion x, y, z, w that rotates it
    TURNED_Y = "turned_y"
    TURNED_Z = "turned_z"
    # of the quaternion of a rotation, and the quaternion of the rotation before it
    COMPOSED_X = "composed_x"
    COMPOSED_Y = "composed_y"
    COMPOSED_Z = "composed_z"
    COMPOSED_W = "composed_w"


@dataclass(frozen=True)
class FunctionRow:
    """The description of a function.

    `rule` is its rule in the semantics. It takes `least` to `most` operands (None: any number).
    `define` gives its expression. `phrase` is its wording for readers, with `{0}` and `{1}` for
    operands, `{all}` for a list of them, and `{vector}` for components of one vector. Results are
    in `range`.

    Solvers cannot compute roots and angles. For a function with `bounds`, a solver knows only that
    the result is in `range`, and these conditions on the operands and the result, in real numbers.
    `easy` then gives cases in which solvers can compute the function, which they use to find
    examples.
    """

    rule: str
    least: int
    most: int | None
    define: Callable[..., Expression]
    phrase: str
    range: tuple[float, float] = (-math.inf, math.inf)
    bounds: Callable[[Expression, Sequence[Expression]], tuple[Condition, ...]] | None = None
    easy: Callable[[Sequence[Expression]], tuple[Easy, ...]] | None = None

    def takes(self, count: int) -> bool:
        """Say whether the function accepts this number of operands."""
        return self.least <= count and (self.most is None or count <= self.most)

    def worded(self, operands: Sequence[str], vector: str | None = None) -> str:
        """The phrase with operands in words. `vector` is the name of the vector whose components
        they are.
        """
        listed = ", ".join(operands)
        return self.phrase.format(*operands, all=listed, vector=vector or f"({listed})")


AnyFunction = Function | RegionFunction
"""A function of all machines, or a function of a region of one machine."""


def row(function: AnyFunction) -> FunctionRow:
    """The row of a function."""
    return _row_of(function) if isinstance(function, RegionFunction) else FUNCTIONS[function]


@cache
def _row_of(function: RegionFunction) -> FunctionRow:
    is_easy = bounds(function, UNKNOWN, tuple(map(Operand, range(OPERANDS)))) is None
    return FunctionRow(
        RULES[function.measure],
        OPERANDS,
        OPERANDS,
        lambda *operands: define(function, operands),
        phrase(function),
        range_of(function),
        None if is_easy else lambda result, operands: bounds(function, result, operands) or (),
        None
        if function.measure is RegionMeasure.INSIDE
        else lambda operands: easy(function, operands),
    )


def parameters(count: int) -> tuple[str, ...]:
    """Names for the operands of a function."""
    names = "ab" if count <= 2 else "xyzw"
    return tuple(names[:count]) if count <= 4 else tuple(f"x_{n}" for n in range(count))


@cache
def defined(function: AnyFunction, count: int) -> Expression:
    """The expression of a function of `count` operands, before S4."""
    return row(function).define(*map(Operand, range(count)))


# --- lesser and greater ----------------------------------------------------------------------


def _minimum(a: Expression, b: Expression) -> Expression:
    """S6: the lesser number. If both numbers are equal, the second."""
    return choose(Either(IsUnknown(a), IsUnknown(b)), UNKNOWN, choose(a < b, a, b))


def _above(a: Expression, b: Expression, c: Expression) -> Expression:
    """S65: the third number if the first is above the second, else 0."""
    is_unknown = Either(IsUnknown(a), Either(IsUnknown(b), IsUnknown(c)))
    return choose(is_unknown, UNKNOWN, choose(a > b, c, 0.0))


def _seen(a: Expression, b: Expression, c: Expression) -> Expression:
    """S77: the first number if the second equals the third, else unknown."""
    is_unknown = Either(IsUnknown(a), Either(IsUnknown(b), IsUnknown(c)))
    return choose(is_unknown, UNKNOWN, choose(b.equals(c), a, UNKNOWN))


def _maximum(a: Expression, b: Expression) -> Expression:
    """S6: the greater number. If both numbers are equal, the second."""
    return choose(Either(IsUnknown(a), IsUnknown(b)), UNKNOWN, choose(a > b, a, b))


def _raised(x: Expression, usual: Expression, most: Expression) -> Expression:
    """S87: a parameter for which greater numbers are tighter."""
    given = choose(usual < x, choose(most < x, usual, x), usual)
    return choose(Either(IsUnknown(x), IsUnknown(most)), usual, given)


def _lowered(x: Expression, usual: Expression, least: Expression) -> Expression:
    """S87: a parameter for which lesser numbers are tighter."""
    given = choose(x < usual, choose(x < least, usual, x), usual)
    return choose(Either(IsUnknown(x), IsUnknown(least)), usual, given)


# --- geometry --------------------------------------------------------------------------------

_SLACK = 2.0**-40
"""More than the rounding errors in a norm of thousands of numbers."""

_TINY = 2.0**-500
"""The number below which squares underflow."""


def _sum_of_squares(*components: Expression) -> Expression:
    """The sum of squares, added from left to right."""
    return reduce(lambda total, x: total + x, [x * x for x in components])


def _norm(*components: Expression) -> Expression:
    """S5: the length of a vector."""
    return square_root(_sum_of_squares(*components))


def _bounds_of_norm(norm: Expression, components: Sequence[Expression]) -> tuple[Condition, ...]:
    """Bounds: a length is at least each component, and at most the sum of all."""
    sizes = [abs(each) for each in components]
    total: Expression = reduce(lambda one, other: one + other, sizes)
    return (
        *(size * (1.0 - _SLACK) - 2.0 * _TINY < norm for size in sizes),
        norm < total * (1.0 + _SLACK) + 2.0 * _TINY,
    )


def _along_one(components: Sequence[Expression]) -> tuple[Easy, ...]:
    """Easy cases: a length equals its component if all other components are 0."""
    return tuple(
        Easy(tuple(other.equals(0.0) for other in components if other is not each), abs(each))
        for each in components
    )


def _roll(x: Expression, y: Expression, z: Expression, w: Expression) -> Expression:
    """S5: the roll of a quaternion."""
    n = Local("n", _sum_of_squares(x, y, z, w))
    sine = 2.0 * (w * x + y * z) / n
    cosine = 1.0 - 2.0 * (x * x + y * y) / n
    return choose(n.equals(0.0), UNKNOWN, ARC_TANGENT(sine, cosine))


def _pitch(x: Expression, y: Expression, z: Expression, w: Expression) -> Expression:
    """S5: the pitch of a quaternion. Rounding may exceed the range of a sine by an ulp, where an
    arc sine is not defined.
    """
    n = Local("n", _sum_of_squares(x, y, z, w))
    sine = Local("sine", 2.0 * (w * y - z * x) / n)
    cut = choose(sine < -1.0, -1.0, choose(sine > 1.0, 1.0, sine))
    return choose(n.equals(0.0), UNKNOWN, ARC_SINE(cut))


def _yaw(x: Expression, y: Expression, z: Expression, w: Expression) -> Expression:
    """S5: the yaw of a quaternion."""
    n = Local("n", _sum_of_squares(x, y, z, w))
    sine = 2.0 * (w * z + x * y) / n
    cosine = 1.0 - 2.0 * (y * y + z * z) / n
    return choose(n.equals(0.0), UNKNOWN, ARC_TANGENT(sine, cosine))


def _unbounded(_: Expression, __: Sequence[Expression]) -> tuple[Condition, ...]:
    """No bounds: the relation between an angle and its quaternion stays open."""
    return ()


def _bounds_of_sine(sine: Expression, angles: Sequence[Expression]) -> tuple[Condition, ...]:
    """Bounds: a sine is at most its angle."""
    return (abs(sine) < abs(angles[0]) * (1.0 + _SLACK) + 2.0 * _TINY,)


def _bounds_of_cosine(cosine: Expression, angles: Sequence[Expression]) -> tuple[Condition, ...]:
    """Bounds: the distance of a cosine from 1 is at most the distance of the angle from 0."""
    return (1.0 - abs(angles[0]) * (1.0 + _SLACK) - _SLACK < cosine,)


# --- all of them -----------------------------------------------------------------------------

_LENGTH = (0.0, math.inf)
_TURN = (-HALF_TURN, HALF_TURN)
_QUARTER = (-RIGHT_ANGLE, RIGHT_ANGLE)
_WAVE = (-1.0, 1.0)
_VECTOR, _TURNING = "{0}, {1}, {2}", "{3}, {4}, {5}, {6}"
_BEHIND, _BEFORE = "{0}, {1}, {2}, {3}", "{4}, {5}, {6}, {7}"

FUNCTIONS: Mapping[Function, FunctionRow] = {
    Function.ADD: FunctionRow("S3", 2, 2, lambda a, b: a + b, "({0} + {1})"),
    Function.SUBTRACT: FunctionRow("S3", 2, 2, lambda a, b: a - b, "({0} - {1})"),
    Function.MULTIPLY: FunctionRow("S3", 2, 2, lambda a, b: a * b, "({0} * {1})"),
    Function.DIVIDE: FunctionRow("S3", 2, 2, lambda a, b: a / b, "({0} / {1})"),
    Function.NEGATE: FunctionRow("S3", 1, 1, lambda a: -a, "-({0})"),
    Function.ABSOLUTE: FunctionRow("S6", 1, 1, abs, "the absolute value of {0}", _LENGTH),
    Function.MINIMUM: FunctionRow("S6", 2, 2, _minimum, "the lesser of ({all})"),
    Function.MAXIMUM: FunctionRow("S6", 2, 2, _maximum, "the greater of ({all})"),
    Function.ABOVE: FunctionRow("S65", 3, 3, _above, "({2} where {0} is above {1}, else 0)"),
    Function.BRAKING_DISTANCE: FunctionRow(
        "S83",
        3,
        3,
        braking_distance,
        "the braking distance (speed: {0}, deceleration: {1}, latency: {2})",
        _LENGTH,
        bounds_of_braking,
    ),
    Function.TIME_TO: FunctionRow(
        "S84",
        2,
        2,
        time_to,
        "the time to contact (distance: {0}, speed: {1})",
        (0.0, LONGEST_TIME),
        bounds_of_time,
    ),
    Function.SEEN: FunctionRow("S77", 3, 3, _seen, "({0} where {1} is {2})"),
    Function.RAISED: FunctionRow(
        "S87", 3, 3, _raised, "({0} where it is above {1}, up to {2}, else {1})"
    ),
    Function.LOWERED: FunctionRow(
        "S87", 3, 3, _lowered, "({0} where it is below {1}, down to {2}, else {1})"
    ),
    Function.NORM: FunctionRow(
        "S5", 1, None, _norm, "the length of {vector}", _LENGTH, _bounds_of_norm, _along_one
    ),
    Function.HYPOT: FunctionRow(
        "S5", 2, 2, _norm, "the length of ({all})", _LENGTH, _bounds_of_norm, _along_one
    ),
    Function.ROLL: FunctionRow("S5", 4, 4, _roll, "the roll of {vector}", _TURN, _unbounded),
    Function.PITCH: FunctionRow("S5", 4, 4, _pitch, "the pitch of {vector}", _QUARTER, _unbounded),
    Function.YAW: FunctionRow("S5", 4, 4, _yaw, "the yaw of {vector}", _TURN, _unbounded),
    Function.SINE: FunctionRow("S69", 1, 1, sine, "the sine of {0}", _WAVE, _bounds_of_sine),
    Function.COSINE: FunctionRow(
        "S69", 1, 1, cosine, "the cosine of {0}", _WAVE, _bounds_of_cosine
    ),
    **{
        function: FunctionRow(
            "S76", 7, 7, define, f"the {axis} of ({_VECTOR}) turned by ({_TURNING})",
            bounds=bounds_of_turned, easy=easy_turned("xyz".index(axis)),
        )
        for function, axis, define in (
            (Function.TURNED_X, "x", turned_x),
            (Function.TURNED_Y, "y", turned_y),
            (Function.TURNED_Z, "z", turned_z),
        )
    },
    **{
        function: FunctionRow(
            "S76", 8, 8, define, f"the {axis} of the turn ({_BEFORE}), turned by ({_BEHIND})",
            bounds=_unbounded, easy=easy_composed("xyzw".index(axis)),
        )
        for function, axis, define in (
            (Function.COMPOSED_X, "x", composed_x),
            (Function.COMPOSED_Y, "y", composed_y),
            (Function.COMPOSED_Z, "z", composed_z),
            (Function.COMPOSED_W, "w", composed_w),
        )
    },
}  # fmt: skip
