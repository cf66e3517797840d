"""The functions of numbers: what their rows say besides their expressions is true of these."""

import math
from fractions import Fraction

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from rossmarie.core import (
    FUNCTIONS,
    Function,
    defined,
    may_be_infinite,
    parameters,
    rounds,
    row,
    shown_by,
)
from rossmarie.core.expressions import (
    Applied,
    Chosen,
    Computed,
    ConstantNumber,
    Expression,
    IsEqual,
    Local,
    Operand,
    Primitive,
)
from rossmarie.interpreter import arithmetic
from support.exact_expressions import holds, value

NUMBERS = st.floats(allow_nan=True, allow_infinity=True)
MODERATE = st.floats(min_value=-1e100, max_value=1e100, allow_nan=False)


def count_of(function: Function) -> int:
    """The most operands of a function, or three."""
    return row(function).most or 3


@st.composite
def applications(
    draw: st.DrawFn, numbers: st.SearchStrategy[float]
) -> tuple[Function, list[float]]:
    function = draw(st.sampled_from(Function))
    count = count_of(function)
    return function, draw(st.lists(numbers, min_size=count, max_size=count))


def test_every_function_has_a_row() -> None:
    assert set(FUNCTIONS) == set(Function)


@pytest.mark.parametrize("function", Function)
def test_the_phrase_names_each_operand(function: Function) -> None:
    names = parameters(count_of(function))
    assert all(name in row(function).worded(names) for name in names)


@given(applications(NUMBERS))
def test_of_what_is_unknown_the_result_is(application: tuple[Function, list[float]]) -> None:
    function, operands = application
    assume(function not in (Function.RAISED, Function.LOWERED))  # of a default they make that
    operands[0] = math.nan
    assert math.isnan(arithmetic.apply(function, tuple(operands)))


@given(applications(NUMBERS))
def test_results_lie_in_their_range(application: tuple[Function, list[float]]) -> None:
    function, operands = application
    result = arithmetic.apply(function, tuple(operands))
    low, high = row(function).range
    assert math.isnan(result) or low <= result <= high


@given(applications(NUMBERS), st.booleans())
@example((Function.ADD, [math.inf, 1.0]), True)
def test_infinite_results_are_announced(
    application: tuple[Function, list[float]], of_infinite: bool
) -> None:
    function, operands = application
    if not of_infinite:
        operands = [math.nan if math.isinf(each) else each for each in operands]
    result = arithmetic.plain(function, tuple(operands))
    announced = may_be_infinite(function, len(operands), of_infinite=of_infinite)
    assert announced or not math.isinf(result)


@given(applications(NUMBERS))
def test_finite_results_show_finite_operands(application: tuple[Function, list[float]]) -> None:
    function, operands = application
    if math.isfinite(arithmetic.plain(function, tuple(operands))):
        shown = shown_by(function, len(operands))
        assert all(math.isfinite(operands[index]) for index in shown)


@given(applications(MODERATE))
def test_bounds_hold_in_real_numbers(application: tuple[Function, list[float]]) -> None:
    function, operands = application
    bounds = row(function).bounds
    result = arithmetic.apply(function, tuple(operands))
    if bounds is None or math.isnan(result):
        return
    numbers = [*map(Fraction, operands), Fraction(result)]
    written = [Operand(index) for index in range(len(numbers))]
    for bound in bounds(written[-1], written[:-1]):
        assert holds(bound, numbers)


@given(applications(MODERATE).filter(lambda each: row(each[0]).easy is not None))
def test_what_is_easy_is_the_function_there(application: tuple[Function, list[float]]) -> None:
    """Each case is met where operands have the values that its conditions name."""
    function, drawn = application
    easy = row(function).easy
    assert easy is not None
    for case in easy(tuple(map(Operand, range(len(drawn))))):
        operands = list(drawn)
        for condition in case.conditions:
            assert isinstance(condition, IsEqual)
            assert isinstance(condition.left, Operand)
            assert isinstance(condition.right, ConstantNumber)
            operands[condition.left.index] = condition.right.value
        numbers = [*map(Fraction, operands)]
        assert all(holds(condition, numbers) for condition in case.conditions)
        found = arithmetic.apply(function, tuple(operands))
        assert found == pytest.approx(float(value(case.value, numbers)), rel=1e-12, abs=1e-150)


@pytest.mark.parametrize("function", Function)
def test_solvers_compute_what_they_are_given(function: Function) -> None:
    """A function with roots or angles, with more than one rounding, or with a quotient that counts
    in some cases only, has bounds instead.
    """
    expression = defined(function, count_of(function))
    operations = operations_in(expression)
    divides_at_times = Primitive.DIVIDE in operations and isinstance(expression, Chosen)
    has_others = any(each not in EASY for each in operations)
    is_hard = len(operations) > 1 or has_others or divides_at_times
    assert is_hard == (row(function).bounds is not None)
    assert rounds(function, count_of(function)) == bool(operations)


EASY = (Primitive.ADD, Primitive.SUBTRACT, Primitive.MULTIPLY, Primitive.DIVIDE)


def operations_in(expression: Expression) -> list[Primitive]:
    """The operations of an expression that round."""
    match expression:
        case ConstantNumber() | Operand():
            return []
        case Local(value=inner):
            return operations_in(inner)
        case Chosen(then=then, otherwise=otherwise):
            return operations_in(then) + operations_in(otherwise)
        case Computed(primitive=primitive, operands=operands):
            below = [each for operand in operands for each in operations_in(operand)]
            is_exact = primitive in (Primitive.NEGATE, Primitive.ABSOLUTE)
            return below if is_exact else [primitive, *below]
        case Applied(function=function, operands=operands):
            below = [each for operand in operands for each in operations_in(operand)]
            return [*operations_in(function.expression), *below]
