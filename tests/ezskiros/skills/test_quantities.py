"""Units of limits, compared with pint, and with what rules mean by them."""

from __future__ import annotations

import math

import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ezskiros.skills.quantities import UNITS, Dimension, read
from rossmarie.units import parse_unit

REGISTRY: pint.UnitRegistry[float] = pint.UnitRegistry()
SI = {each: REGISTRY.parse_units(each.value) for each in Dimension}


@pytest.mark.parametrize("name", UNITS)
def test_a_unit_is_what_pint_says(name: str) -> None:
    unit = UNITS[name]
    expected = REGISTRY.Quantity(3.0, name).to(SI[unit.dimension]).magnitude
    assert math.isclose(unit.si(3.0), expected, rel_tol=1e-14)


@pytest.mark.parametrize("name", UNITS)
def test_rules_mean_the_same_by_a_unit(name: str) -> None:
    unit, theirs = UNITS[name], parse_unit(name)
    assert theirs.dimension == parse_unit(unit.dimension.value).dimension
    assert math.isclose(unit.si(1.0), theirs.scale, rel_tol=1e-15)


@given(st.floats(allow_nan=False), st.sampled_from([*UNITS]), st.sampled_from(["", " ", "\t "]))
def test_what_is_written_is_read(number: float, unit: str, between: str) -> None:
    is_word = math.isinf(number)
    written = read(f"{number!r}{' ' if is_word else between}{unit}")
    assert written is not None
    assert (written.number, written.unit) == (number, unit)
    assert written.has_minus == (math.copysign(1.0, number) < 0)


@given(st.text())
def test_any_text_is_read_or_not(text: str) -> None:
    written = read(text)
    assert written is None or isinstance(written.number, float)


@given(st.floats(min_value=0, max_value=1e300), st.sampled_from([*UNITS]))
def test_more_is_more_in_si(number: float, unit: str) -> None:
    si = UNITS[unit].si(number)
    assert si >= 0
    assert UNITS[unit].si(number * 2) >= si
