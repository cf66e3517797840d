import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rossmarie.units import (
    ALIASES,
    DIMENSIONLESS,
    SYMBOLS,
    Unit,
    UnknownUnitError,
    divide,
    factor_of,
    multiply,
    parse_unit,
    si_unit,
    unit_of_differences,
)

WITHOUT_OFFSET = sorted(symbol for symbol, row in SYMBOLS.items() if not row.offset)


@st.composite
def units(draw: st.DrawFn) -> Unit:
    """Products of up to three powers of symbols."""
    factors = draw(
        st.lists(
            st.tuples(st.sampled_from(WITHOUT_OFFSET), st.sampled_from(".*/"), st.integers(1, 3)),
            min_size=1,
            max_size=3,
        )
    )
    text = "".join(f"{sign}{symbol}^{power}" for symbol, sign, power in factors)
    return parse_unit(text[1:])


@pytest.mark.parametrize(
    ("text", "symbol", "dimension", "scale"),
    [
        ("m/s", "m/s", "length/time", 1.0),
        ("N/sec", "N/s", "mass*length/time^3", 1.0),
        ("Nm", "N*m", "mass*length^2/time^2", 1.0),
        ("kgm", "kg*m", "mass*length", 1.0),
        ("kgm.m", "kg*m^2", "mass*length^2", 1.0),
        ("m/s^2", "m/s^2", "length/time^2", 1.0),
        ("m.s^-1", "m/s", "length/time", 1.0),
        ("m/s/s", "m/s^2", "length/time^2", 1.0),
        ("rad/s", "rad/s", "angle/time", 1.0),
        ("deg", "deg", "angle", math.pi / 180),
        ("°", "deg", "angle", math.pi / 180),
        ("rpm", "rpm", "angle/time", 0.10471975511965978),
        ("km/h", "km/h", "length/time", 1000 / 3600),
        ("mm", "mm", "length", 0.001),
        ("Hz", "Hz", "time^-1", 1.0),
        ("g", "g", "mass", 0.001),
        ("g0", "g0", "length/time^2", 9.80665),
        ("%", "%", "dimensionless", 0.01),
        ("m/m", "1", "dimensionless", 1.0),
        ("1", "1", "dimensionless", 1.0),
        ("Ah", "Ah", "current*time", 3600.0),
    ],
)
def test_text_means(text: str, symbol: str, dimension: str, scale: float) -> None:
    unit = parse_unit(text)
    assert (unit.symbol, str(unit.dimension), unit.scale) == (symbol, dimension, scale)
    assert unit.offset == 0


@pytest.mark.parametrize("text", [*SYMBOLS, *ALIASES])
def test_every_symbol_and_alias_is_a_unit(text: str) -> None:
    unit = parse_unit(text)
    assert parse_unit(unit.symbol) == unit


@pytest.mark.parametrize(
    ("text", "part", "suggestion"),
    [
        ("hz", "hz", "Hz"),
        ("M/s", "M", "m/s"),
        ("M/S", "M", "m/s"),
        ("NM", "NM", "Nm"),
        ("mpa", "mpa", "MPa"),
        ("meters/s", "meters", "m/s"),
        ("Newtons", "Newtons", "N"),
        ("m/s2", "s2", "m/s^2"),
        ("m²", "m²", "m^2"),
        ("m/s**2", "s**2", "m/s^2"),
        ("1/s", "1", "Hz"),
        ("1/m", "1", "m^-1"),
        ("Nkg", "Nkg", "N*kg"),
        ("C", "C", "degC"),
        ("degC/s", "degC", "K/s"),
        ("°C/min", "degC", "K/min"),
        ("radd/s", "radd", "rad/s"),
    ],
)
def test_unknown_units_name_the_part_and_suggest(text: str, part: str, suggestion: str) -> None:
    with pytest.raises(UnknownUnitError) as caught:
        parse_unit(text)
    assert caught.value.text == text
    assert caught.value.suggestions[0] == suggestion
    assert caught.value.part == part or "**" in text


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("mps", "m/s"),
        ("kmh", "km/h"),
        ("KPH", "km/h"),
        ("mins", "min"),
        ("secs", "s"),
        ("degs", "deg"),
        ("degs/s", "deg/s"),
        ("dps", "deg/s"),
        ("rads", "rad"),
        ("rads/sec", "rad/sec"),
        ("radps", "rad/s"),
        ("millis", "ms"),
    ],
)
def test_everyday_spellings_are_understood_before_all_else(text: str, meant: str) -> None:
    with pytest.raises(UnknownUnitError) as caught:
        parse_unit(text)
    assert caught.value.suggestions == (meant,)


@pytest.mark.parametrize("text", ["mph", "ft", "inch", "feet", "ft/s", "psi"])
def test_units_of_other_systems_are_not_taken_for_misspellings(text: str) -> None:
    with pytest.raises(UnknownUnitError) as caught:
        parse_unit(text)
    assert caught.value.suggestions == ()
    assert factor_of(caught.value.part) is not None


@pytest.mark.parametrize(
    "text", ["", "foo", "m//s", "m/", "/s", "m^", "m^0", "m^100", "m s", "()", "m^2^2", "2"]
)
def test_nonsense_is_refused(text: str) -> None:
    with pytest.raises(UnknownUnitError):
        parse_unit(text)


@pytest.mark.parametrize("text", ["km^99", "nm^-33", "m." * 100_000 + "m", "x" * 100_000])
def test_huge_units_are_refused_quickly(text: str) -> None:
    with pytest.raises(UnknownUnitError):
        parse_unit(text)


@given(st.text(alphabet="kgmsNradeCHz%°*./^-0123456789 1", max_size=12))
def test_any_text_is_a_unit_or_refused_with_units_as_suggestions(text: str) -> None:
    try:
        parse_unit(text)
    except UnknownUnitError as error:
        for suggestion in error.suggestions:
            parse_unit(suggestion)


def test_what_is_suggested_has_temperatures_in_kelvin() -> None:
    with pytest.raises(UnknownUnitError) as caught:
        parse_unit("C/H")
    assert caught.value.suggestions
    for suggestion in caught.value.suggestions:
        parse_unit(suggestion)


def test_scales_are_rounded_once() -> None:
    pi = Fraction("3.14159265358979323846264338327950288")
    for text, exact in {"rpm": pi / 30, "deg/h": pi / 180 / 3600, "km/h": Fraction(10, 36)}.items():
        scale = parse_unit(text).scale
        error = abs(Fraction(scale) - exact)
        assert error <= abs(Fraction(math.nextafter(scale, 0)) - exact)
        assert error <= abs(Fraction(math.nextafter(scale, 1)) - exact)


def test_temperature_converts_with_its_offset() -> None:
    celsius = parse_unit("degC")
    assert celsius.to_si(20.0) == 293.15
    assert celsius.from_si(273.15) == 0.0
    assert celsius.dimension == parse_unit("K").dimension
    assert unit_of_differences(celsius) == parse_unit("K")
    assert unit_of_differences(parse_unit("km")) == parse_unit("km")
    assert multiply(celsius, parse_unit("s")) == parse_unit("K*s")


def test_an_angle_is_no_number() -> None:
    assert parse_unit("rad").dimension != DIMENSIONLESS.dimension
    assert parse_unit("rad/s").dimension != parse_unit("Hz").dimension


def test_products_cancel() -> None:
    assert multiply(parse_unit("m/s"), parse_unit("s")) == parse_unit("m")
    assert divide(parse_unit("N"), parse_unit("N")) == DIMENSIONLESS
    assert divide(DIMENSIONLESS, parse_unit("s")) == parse_unit("s^-1")


@pytest.mark.parametrize("text", ["N", "N*m", "Hz", "m/s", "W", "V", "T", "Pa", "kg*m^2", "1"])
def test_si_units_have_their_usual_names(text: str) -> None:
    assert si_unit(parse_unit(text).dimension) == parse_unit(text)


@given(units(), units())
def test_multiplication_commutes(left: Unit, right: Unit) -> None:
    one, other = multiply(left, right), multiply(right, left)
    assert (one.dimension, one.scale) == (other.dimension, other.scale)


@given(units(), units(), units())
def test_multiplication_is_associative(a: Unit, b: Unit, c: Unit) -> None:
    one, other = multiply(multiply(a, b), c), multiply(a, multiply(b, c))
    assert (one.dimension, one.scale) == (other.dimension, other.scale)


@given(units(), units())
def test_division_undoes_multiplication(left: Unit, right: Unit) -> None:
    again = divide(multiply(left, right), right)
    assert (again.dimension, again.scale) == (left.dimension, left.scale)


@given(units())
def test_one_is_neutral(unit: Unit) -> None:
    assert multiply(unit, DIMENSIONLESS) == multiply(DIMENSIONLESS, unit) == unit
    assert divide(unit, DIMENSIONLESS) == unit
    assert divide(unit, unit) == DIMENSIONLESS


@given(units())
def test_symbols_can_be_read_back(unit: Unit) -> None:
    assert parse_unit(unit.symbol) == unit


@given(units(), units())
def test_si_values_multiply_like_units(left: Unit, right: Unit) -> None:
    product = multiply(left, right)
    assert math.isclose(
        product.to_si(6.0), left.to_si(2.0) * right.to_si(3.0), rel_tol=1e-14, abs_tol=0.0
    )


@given(units(), st.floats(-1e6, 1e6))
def test_conversion_goes_there_and_back(unit: Unit, number: float) -> None:
    # Smaller numbers may become subnormal in SI, and lose digits.
    assert math.isclose(unit.from_si(unit.to_si(number)), number, rel_tol=1e-15, abs_tol=1e-200)


def test_endless_products_stay_finite_and_keep_their_dimension() -> None:
    unit = kilometre = parse_unit("km")
    for _ in range(500):
        unit = multiply(unit, kilometre)
    assert unit.scale == 1.0
    assert str(unit.dimension) == "length^501"
