"""Numbers: rules S3 to S6 of docs/explanation/semantics.md."""

import math

import pytest

from rossmarie.ir import Function
from support.bench import Bench
from support.drafts import Draft
from support.machines import NAN

UPRIGHT = (0.43788759365057206, 0.49581224138185065)
"""x and y of an orientation (x, y, -x, y) whose pitch rounding takes beyond the range of asin."""


def result_of(function: Function, *values: float) -> float:
    """A function of numbers that arrive in messages."""
    draft = Draft()
    operands = [draft.read() for _ in values]
    result = draft.apply(function, *operands)
    bench = Bench(draft)
    bench.send(0, **{f"c{index}": value for index, value in enumerate(values)})
    return bench.signal(result)


def test_s3_every_operation_is_rounded_on_its_own() -> None:
    # With a fused multiply-add the sum would keep the 2**-60 that the product loses.
    draft = Draft()
    x, y, z = (draft.read() for _ in range(3))
    total = draft.apply(Function.ADD, draft.apply(Function.MULTIPLY, x, y), z)
    bench = Bench(draft)
    bench.send(0, c0=1 + 2.0**-30, c1=1 + 2.0**-30, c2=-(1 + 2.0**-29))
    assert bench.signal(total) == 0.0


@pytest.mark.parametrize(
    ("function", "operands"),
    [
        (Function.ADD, (1.7e308, 1.7e308)),
        (Function.MULTIPLY, (1e200, -1e200)),
        (Function.DIVIDE, (1.0, 0.0)),
        (Function.DIVIDE, (0.0, 0.0)),
        (Function.DIVIDE, (1e308, 1e-308)),
        (Function.NORM, (1e200, 0.0)),
    ],
)
def test_s4_results_that_are_not_finite_are_unknown(
    function: Function, operands: tuple[float, ...]
) -> None:
    assert math.isnan(result_of(function, *operands))


def test_s5_norm() -> None:
    assert result_of(Function.NORM, 2.0, 3.0, 6.0) == 7.0
    assert result_of(Function.NORM, -2.0) == 2.0


def test_s5_hypot() -> None:
    assert result_of(Function.HYPOT, -3.0, 4.0) == 5.0
    assert math.isnan(result_of(Function.HYPOT, 1e200, 0.0))  # its square is too large (S4)


@pytest.mark.parametrize("length", [1.0, 0.01, 700.0])
@pytest.mark.parametrize("angles", [(0.5, 0.0, 0.0), (0.1, -0.7, 2.5), (-3.0, 1.5, -0.3)])
def test_s5_angles_of_an_orientation_of_any_length(
    length: float, angles: tuple[float, float, float]
) -> None:
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(a / 2), math.cos(a / 2)) for a in angles)
    orientation = (  # yaw about z, then pitch about y, then roll about x (REP 103)
        length * (sr * cp * cy - cr * sp * sy),
        length * (cr * sp * cy + sr * cp * sy),
        length * (cr * cp * sy - sr * sp * cy),
        length * (cr * cp * cy + sr * sp * sy),
    )
    functions = (Function.ROLL, Function.PITCH, Function.YAW)
    found = tuple(result_of(function, *orientation) for function in functions)
    assert found == pytest.approx(angles)


def test_s5_angles_are_the_same_everywhere() -> None:
    functions = (Function.ROLL, Function.PITCH, Function.YAW)
    orientations = ((0.1, 0.2, 0.3, 0.4), (-0.7, 0.1, 0.5, 0.3), (3.0, -2.0, 0.25, 1.0))
    found = [[result_of(each, *values).hex() for each in functions] for values in orientations]
    assert found == [
        ["0x1.921fb54442d18p-1", "0x1.5bfe34f051113p-2", "0x1.6dcc57bb565fcp+0"],
        ["-0x1.0468a8ace4df6p+1", "0x1.217d71a3685b0p+0", "0x1.dac670561bb50p-2"],
        ["0x1.5f5a54b7278eap+1", "-0x1.9b7b916bcd5d8p-2", "-0x1.181cde0695be7p+0"],
    ]


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_s5_a_sine_beyond_one_is_cut(sign: float) -> None:
    x, y = UPRIGHT
    assert (2.0 * (y * y + x * x)) / (((x * x + y * y) + x * x) + y * y) > 1.0
    pitch = result_of(Function.PITCH, x, sign * y, -sign * x, y)
    assert pitch == sign * math.pi / 2


def test_s5_an_orientation_of_zeros_is_unknown() -> None:
    for function in (Function.ROLL, Function.PITCH, Function.YAW):
        assert math.isnan(result_of(function, 0.0, 0.0, 0.0, 0.0))


def test_s6_minimum_and_maximum() -> None:
    assert result_of(Function.MINIMUM, 1.0, 2.0) == 1.0
    assert result_of(Function.MAXIMUM, 1.0, 2.0) == 2.0
    assert math.isnan(result_of(Function.MINIMUM, NAN, 1.0))
    assert math.isnan(result_of(Function.MAXIMUM, 1.0, NAN))
    # Of equal ones it is the second, which shows in the sign of zero.
    assert math.copysign(1.0, result_of(Function.MINIMUM, 0.0, -0.0)) == -1.0
    assert math.copysign(1.0, result_of(Function.MAXIMUM, -0.0, 0.0)) == 1.0
    assert math.copysign(1.0, result_of(Function.ABSOLUTE, -0.0)) == 1.0
